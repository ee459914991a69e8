// What every stage of a run has at hand.
#pragma once

#include <string>
#include <utility>
#include <vector>

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
  bool begun = false;  // the directory holds this run's files (begin_results.h)
  std::vector<StageCost> costs{};

  // Runs one stage: shows it, measures it, and returns what it made.
  template <class Work>
  auto stage(const std::string& name, const std::string& text, Work work) {
    progress.start(name, text);
    const StageClock clock(name);
    auto result = work();
    costs.push_back(clock.read());
    progress.finish("");
    return result;
  }
};

}  // namespace scree::run
