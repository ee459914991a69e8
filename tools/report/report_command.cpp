#include "tools/report/report_command.h"

#include <filesystem>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "tools/report/run_report.h"
#include "tools/report/study_report.h"
#include "tools/run/output_place.h"
#include "tools/run/run_files.h"

namespace scree::report {

void declare_report(CLI::App& command, ReportArguments& arguments) {
  command.add_option("directory", arguments.directory, "the --out of a run or a study")->required();
  command.add_option("--page", arguments.page, "where the page goes (default: report.html in the directory)");
  CLI::Option* without = command.add_flag("--no-pictures", arguments.without_pictures, "leave the pictures of a run out");
  command.add_flag("--animations", arguments.animations, "also animations of the fall and the heating")->excludes(without);
}

int report_command(const ReportArguments& arguments) {
  const std::filesystem::path directory = std::filesystem::path(arguments.directory + "/").parent_path();
  const bool study =
      std::filesystem::exists(directory / "table.csv") && !std::filesystem::exists(run::RunFiles{directory}.summary());
  const Pictures pictures = arguments.without_pictures ? Pictures::none
                            : arguments.animations     ? Pictures::animated
                                                       : Pictures::still;
  const std::filesystem::path page =
      arguments.page.empty() ? run::RunFiles{directory}.page() : std::filesystem::path(arguments.page);
  if (!arguments.page.empty()) run::check_output_place("--page", page, {".html", ".htm"});
  write_text(page, study ? study_page(directory) : run_page({directory}, pictures));
  fmt::print("{}\n", page.string());
  return 0;
}

}  // namespace scree::report
