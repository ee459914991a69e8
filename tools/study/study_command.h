// `scree study`: a base scene, what varies, and a table of what came of it.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace scree::study {

struct Arguments {
  std::string study;
  std::string directory;  // empty: out/ and the study's name
  int jobs = 0;           // 0: as many as there are processors
  int threads = 0;        // of each run; 0: the processors shared out
  bool quiet = false;
  bool json = false;  // progress for a program
  // At most one of these; none: all runs here and now.
  int task = 0;          // this run alone
  bool gather = false;   // no run, the table alone
  bool list = false;     // only say what the runs are
  std::string slurm;     // write a job array there
  std::string parallel;  // write a script for GNU parallel there
};

void declare(CLI::App& command, Arguments& arguments);

int run(const Arguments& arguments);

}  // namespace scree::study
