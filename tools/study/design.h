// The points of a study: which values stand together in a run.
#pragma once

#include <vector>

#include "tools/study/study.h"

namespace scree::study {

struct Point {
  std::size_t number = 0;     // of the combination, without the ensemble, from 0
  std::vector<Level> levels;  // in the order of Study::varied()
};

// How many points are asked for, before any of them is made.
double run_count(const Study& study);

// Every combination, the first key slowest, or the points of the Latin hypercube that differ; the members of the ensemble
// fastest.
std::vector<Point> points_of(const Study& study);

}  // namespace scree::study
