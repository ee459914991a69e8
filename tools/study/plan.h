// The runs of a study.
#pragma once

#include <string>
#include <vector>

#include "tools/study/design.h"

namespace scree::study {

struct PlannedRun {
  int number = 0;  // from 1
  Point point;
  std::vector<std::string> overrides;    // as `--set` takes them
  std::string directory;                 // below the study's `runs`; named after all that the run depends on
  std::string packing;                   // runs of one name come to the same packing; empty: nothing falls
  std::vector<std::string> bare_values;  // those of the scene with these overrides
};

// Reads the scene of every run. Throws InputError with everything that does not suit, at its place in the study file.
std::vector<PlannedRun> plan(const Study& study);

}  // namespace scree::study
