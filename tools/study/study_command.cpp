#include "tools/study/study_command.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/progress.h"
#include "engine/base/threads.h"
#include "tools/run/interrupt.h"
#include "tools/run/output_place.h"
#include "tools/study/batch.h"
#include "tools/study/conductor.h"
#include "tools/study/ensembles.h"
#include "tools/study/gather.h"
#include "tools/study/memory.h"
#include "tools/study/outcome.h"
#include "tools/study/packings.h"
#include "tools/study/read_study.h"

namespace scree::study {

namespace {

namespace fs = std::filesystem;

std::optional<int> given(int option) {
  return option > 0 ? std::optional<int>(option) : std::nullopt;
}

// Several may gather at once: the jobs of an array, each at its end.
Table write_tables(const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  const run::FileLock lock = run::FileLock::wait(files.tables_lock());
  Table table = gather(study, runs, files);
  write_text(files.table(), to_csv(table));
  write_hdf5(table, files.table_hdf5());
  if (study.ensemble) {
    const Table ensembles = ensembles_of(study, table);
    write_text(files.ensembles(), to_csv(ensembles));
    write_hdf5(ensembles, files.ensembles_hdf5());
  } else {
    for (const fs::path& earlier : {files.ensembles(), files.ensembles_hdf5()}) fs::remove(earlier);
  }
  return table;
}

// The table on the way. Each is made of all runs anew, so that tables of many short runs would take longer than these: it waits
// until those before it have taken no more than a part of the time.
class TablesOnTheWay {
 public:
  template <class Write>
  void next(const Write& write) {
    constexpr double most = 0.05;
    const auto start = Clock::now();
    if (taken_ > most * (start - begin_)) return;
    write();
    taken_ += Clock::now() - start;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
  std::chrono::duration<double> taken_{0};
};

// The table of the runs, and what is to be said of it. Complete only if all runs are, and all their figures are there.
Ending conclude(const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  const Table table = write_tables(study, runs, files);
  const Standing standing = standing_of(table);
  Ending ending;
  ending.directory = files.directory.string();
  ending.reasons = paths_not_found(study, runs, files);
  const bool whole = standing.complete == runs.size() && ending.reasons.empty();
  ending.status = whole ? "complete" : "incomplete";
  ending.exit_status = whole ? 0 : 1;
  if (standing.complete < runs.size()) {
    ending.reasons.push_back(fmt::format("{} of {} runs complete, {} failed or unsound, {} not made: {}", standing.complete,
                                         runs.size(), standing.unsound, standing.open, files.table().string()));
  }
  return ending;
}

// Says how a study ended, and gives the exit status.
int finish(const Ending& ending, Progress& progress) {
  progress.end(ending);
  for (const std::string& reason : ending.reasons) fmt::print(stderr, "{}\n", reason);
  return ending.exit_status;
}

ProgressMode mode_of(const Arguments& arguments) {
  return arguments.json ? ProgressMode::json : progress_mode(arguments.quiet);
}

int make_all(const Arguments& arguments, const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  const auto lock = run::FileLock::of_command(files.lock(), run::FileLock::Kind::exclusive, "study");
  publish_packings(files, runs);
  Progress progress(mode_of(arguments));
  progress.start("study", fmt::format("{} runs", runs.size()));
  Means means;
  means.jobs = given(arguments.jobs).value_or(available_processors());
  means.threads = given(arguments.threads);
  means.memory = available_memory();
  const auto write = [&] { write_tables(study, runs, files); };
  TablesOnTheWay tables;
  try {
    Conductor(study, files, means, progress, [&] { tables.next(write); }).make(runs);
  } catch (...) {
    write();
    throw;
  }
  progress.finish("");
  return finish(conclude(study, runs, files), progress);
}

int make_one(const Arguments& arguments, const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  if (arguments.task > static_cast<int>(runs.size())) {
    Problem problem;
    problem.key = "--task";
    problem.value = fmt::format("{}", arguments.task);
    problem.rule = fmt::format("must be at most {}, the number of runs", runs.size());
    throw InputError(problem);
  }
  const auto lock = run::FileLock::of_command(files.lock(), run::FileLock::Kind::shared, "study");
  publish_packings(files, runs);
  Progress progress(mode_of(arguments));
  progress.start("study", fmt::format("run {}", arguments.task));
  const Means means{1, given(arguments.threads), available_memory()};
  const PlannedRun& one = runs[static_cast<std::size_t>(arguments.task) - 1];
  Conductor(study, files, means, progress, [] {}).make({one});
  progress.finish("");
  const Outcome outcome = read_outcome(files, one.directory);
  const bool sound = outcome.status == "complete";
  Ending ending{outcome.status, sound ? 0 : 1, files.run(one.directory).directory.string(), {}};
  if (!outcome.reason.empty()) ending.reasons.push_back(outcome.reason);
  return finish(ending, progress);
}

// Over a script that was written before, but nothing else.
void write_script(const std::string& option, const std::string& file, const std::string& script) {
  constexpr std::string_view beginning = "#!/bin/sh\n# Runs ";
  std::string there(beginning.size(), '\0');
  std::ifstream old(file, std::ios::binary);
  if (old && (!old.read(there.data(), static_cast<std::streamsize>(there.size())) || there != beginning)) {
    Problem problem;
    problem.key = option;
    problem.value = file;
    problem.rule = "must not be a file that is there and is no such script";
    throw InputError(problem);
  }
  write_text(file, script);
  fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
}

int list(const std::vector<PlannedRun>& runs) {
  for (const PlannedRun& run : runs) {
    fmt::print("{:>4}", run.number);
    for (const std::string& assignment : run.overrides) fmt::print("  {}", assignment);
    fmt::print("\n");
  }
  return 0;
}

fs::path directory_of(const Arguments& arguments) {
  return arguments.directory.empty() ? fs::path("out") / fs::path(arguments.study).stem() : fs::path(arguments.directory);
}

// What was asked for and is not among the runs.
void say_repeats(const Study& study, const std::vector<PlannedRun>& runs, Progress& progress) {
  const double asked = run_count(study);
  if (asked == static_cast<double>(runs.size())) return;
  progress.note(fmt::format("study: {} runs instead of {:.0f}, for points of the Latin hypercube that are equal are made once",
                            runs.size(), asked));
}

// What the study says, and what its runs would say one by one.
void say_suspicions(const Study& study, const std::vector<PlannedRun>& runs, Progress& progress) {
  std::set<std::string> said;
  const auto say = [&](const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) {
      if (said.insert(sentence).second) progress.note("suspicious: " + sentence);
    }
  };
  say(study.bare_values);
  for (const PlannedRun& run : runs) say(run.bare_values);
}

int dispatch(const Arguments& arguments, const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  if (arguments.gather) {
    Progress progress(mode_of(arguments));
    return finish(conclude(study, runs, files), progress);
  }
  const Batch batch{arguments.study, files.directory, static_cast<int>(runs.size()), given(arguments.threads)};
  if (!arguments.slurm.empty()) write_script("--slurm", arguments.slurm, slurm_script(batch));
  if (!arguments.parallel.empty()) write_script("--parallel", arguments.parallel, parallel_script(batch));
  if (!arguments.slurm.empty() || !arguments.parallel.empty()) return 0;
  return arguments.task > 0 ? make_one(arguments, study, runs, files) : make_all(arguments, study, runs, files);
}

int plan_and_make(const Arguments& arguments) {
  const Study study = read_study(arguments.study);
  const std::vector<PlannedRun> runs = plan(study);
  {
    Progress progress(mode_of(arguments));
    say_repeats(study, runs, progress);
    say_suspicions(study, runs, progress);
  }
  if (arguments.list) return list(runs);
  const StudyFiles files{directory_of(arguments)};
  for (const char* folder : {"runs", "packings"}) run::make_output_folder(files.directory / folder);
  run::catch_interrupts();
  return dispatch(arguments, study, runs, files);
}

// A program that follows the study is told how it ended in its own way.
void tell_end(const Arguments& arguments, const std::string& status, int exit_status, const std::string& reason) {
  if (arguments.json) Progress(ProgressMode::json).end({status, exit_status, "", {reason}});
}

}  // namespace

void declare(CLI::App& command, Arguments& arguments) {
  command.add_option("study", arguments.study, "the study, a YAML file")->required();
  command.add_option("--out", arguments.directory, "where the results go (default: out/ and the study's name)");
  command.add_option("--jobs", arguments.jobs, "runs side by side (default: the processors there are)")
      ->check(CLI::Range(1, 4096));
  command.add_option("--threads", arguments.threads, "of each run (default: the processors shared out)")
      ->check(CLI::Range(1, 1024));
  CLI::Option* quiet = command.add_flag("--quiet", arguments.quiet, "say nothing but what is wrong");
  command.add_flag("--json", arguments.json, "progress for a program: one JSON object a line on standard output")
      ->excludes(quiet);
  auto* what = command.add_option_group("instead of making all runs here");
  what->add_option("--task", arguments.task, "make only the run of this number, counted from 1")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  what->add_flag("--gather", arguments.gather, "make no run, only the table of those that there are");
  what->add_flag("--list", arguments.list, "make no run, only say what they are");
  what->add_option("--slurm", arguments.slurm, "write a job array for Slurm whose tasks are the runs");
  what->add_option("--parallel", arguments.parallel, "write a script that makes the runs by GNU parallel");
  what->require_option(0, 1);
  what->set_help_flag();
}

int run(const Arguments& arguments) {
  try {
    return plan_and_make(arguments);
  } catch (const run::Interrupted&) {
    constexpr const char* words = "interrupted; the same command goes on";
    tell_end(arguments, "interrupted", 130, words);
    fmt::print(stderr, "scree: {}\n", words);
    return 130;
  } catch (const InputError& error) {
    tell_end(arguments, "bad_input", 2, error.what());
    throw;
  } catch (const std::exception& error) {
    tell_end(arguments, "failed", 1, error.what());
    throw;
  }
}

}  // namespace scree::study
