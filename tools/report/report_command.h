// `scree report`: one page about a run or a study.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace scree::report {

struct ReportArguments {
  std::string directory;
  std::string page;  // empty: report.html in the directory
  bool without_pictures = false;
  bool animations = false;
};

void declare_report(CLI::App& command, ReportArguments& arguments);

int report_command(const ReportArguments& arguments);

}  // namespace scree::report
