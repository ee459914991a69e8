// The forest of a factor's supernodes: the parent of one is the supernode that holds the first of its rows below its columns.
// Different trees of it have nothing to do with each other until they meet.
#pragma once

#include <cstdint>
#include <vector>

#include "thermal/supernodal_pattern.h"

namespace scree::thermal {

// The forest cut into trees that can be gone through at once, and what is above them.
struct CutForest {
  struct Tree {
    std::vector<int> supernodes;  // ascending: each after those below it
    std::int64_t weight = 0;
  };
  std::vector<Tree> trees;  // the first half of them, with which one of two threads begins, weighs about as much as the second
  std::vector<int> top;     // ascending
};

// Cut until none weighs more than a part of all, one of so many, or than `least`, for which a second thread is not worth waking
// up. Those that are left are put together to trees of like weights. How depends on the supernodes' weights alone.
CutForest cut_forest(const SupernodalPattern& pattern, const std::vector<std::int64_t>& weights, int parts, std::int64_t least);

}  // namespace scree::thermal
