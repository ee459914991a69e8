// What every stage of a run has at hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/files_together.h"
#include "engine/base/progress.h"
#include "engine/base/stage_clock.h"
#include "tools/run/interrupt.h"
#include "tools/run/run_files.h"
#include "tools/scene/scene.h"

namespace scree::run {

struct RunContext {
  const Scene& scene;
  RunFiles files;
  Progress& progress;
  bool resume = false;
  bool estimate_space_error = false;
  bool begun = false;          // the directory holds this run's files (begin_results.h)
  FilesTogether last_files{};  // which wait for the summary
  std::vector<StageCost> costs{};
  std::vector<std::string> remarks{};  // for whoever reads the results
  StageClock* running = nullptr;       // of the present stage, if any

  // What a user should know of the results, though it makes them no less sound: said at once, and kept for the summary.
  void remark(std::string text) {
    progress.note(text);
    remarks.push_back(std::move(text));
  }

  // Runs one stage: shows it, measures it, and returns what it made. Throws Interrupted before it.
  template <class Work>
  auto stage(const std::string& name, const std::string& text, Work work) {
    check_interrupt();
    progress.start(name, text);
    StageClock clock(name);
    running = &clock;
    auto result = work();
    costs.push_back(clock.read());
    running = nullptr;
    progress.finish("");
    return result;
  }

  // Within a stage what is measured by itself and does not count there.
  template <class Work>
  void aside(const std::string& name, Work work) {
    running->pause();
    const StageClock clock(name);
    work();
    costs.push_back(clock.read());
    running->resume();
  }
};

}  // namespace scree::run
