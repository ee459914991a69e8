// Makes the runs of a study: side by side, each packing once, on from where an earlier start ended.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "tools/run/child_process.h"
#include "tools/run/file_lock.h"
#include "tools/study/forecast.h"
#include "tools/study/plan.h"
#include "tools/study/study_files.h"

namespace scree::study {

struct Means {
  int jobs = 1;                // runs side by side at most
  std::optional<int> threads;  // of each run; nothing: the processors shared out
  std::int64_t memory = 0;     // that the runs may take together [bytes]
};

class Conductor {
 public:
  // `after_each` is called whenever a run has ended.
  Conductor(const Study& study, StudyFiles files, const Means& means, Progress& progress, std::function<void()> after_each);

  // Makes those of the runs that have no final result yet. Throws run::Interrupted when Ctrl-C or SIGTERM has come and all of
  // them have stopped.
  void make(const std::vector<PlannedRun>& runs);

 private:
  struct Active {
    const PlannedRun* run;
    bool resumed;
    run::ChildProcess process;
    std::optional<run::FileLock> settling;  // it makes the packing that others wait for
  };

  void choose(const std::vector<PlannedRun>& runs);
  void start_what_can();
  [[nodiscard]] bool has_room() const;
  bool try_start(const PlannedRun& run);
  void start(const PlannedRun& run, std::optional<run::FileLock> settling);
  [[nodiscard]] std::vector<std::string> command_of(const PlannedRun& run, bool resumes) const;
  void collect();
  void finish(Active& active, const run::ChildEnd& end);
  void begin_anew(const PlannedRun& run);
  void stop_all();
  void show(const std::string& event);
  const Study& study_;
  StudyFiles files_;
  Means means_;
  Progress& progress_;
  std::function<void()> after_each_;
  std::deque<const PlannedRun*> waiting_;
  std::vector<Active> active_;
  std::map<std::string, std::string> failed_packings_;  // why, by packing
  std::size_t all_ = 0;
  std::size_t done_ = 0;
  std::size_t failed_ = 0;
  Forecast forecast_;
  std::set<const PlannedRun*> settling_runs_;  // the first of each packing that has to be made
  double largest_run_ = 0;                     // peak memory of any run that has ended [bytes]; 0: not known yet
};

}  // namespace scree::study
