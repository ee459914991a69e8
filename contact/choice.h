// Which of several candidates a semi-spring or a semi-edge takes.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace scree::contact {

// Distances that differ by less than this, in characteristic lengths, are equal: more than rounding, less than any gap that
// matters.
inline constexpr double equal_distance = 1e-6;
inline constexpr double equal_score = 1e-6;  // the same for the cosine or fraction that decides between them

template <class Target>
struct Candidate {
  Target target;
  double distance;  // [m]
  double score;     // the lower the better among those equally close
};

// The one with the least distance; among those that are as close to `equal` [m], the one with the lowest score, then the lowest
// id. Null if there is none.
template <class Candidates>
auto best_of(Candidates& candidates, double equal) -> decltype(candidates.data()) {
  if (candidates.size() == 1) return candidates.data();
  double least = std::numeric_limits<double>::infinity();
  for (const auto& candidate : candidates) least = std::min(least, candidate.distance);
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.target < b.target; });
  decltype(candidates.data()) best = nullptr;
  for (auto& candidate : candidates) {
    if (candidate.distance > least + equal) continue;
    if (best == nullptr || candidate.score < best->score - equal_score) best = &candidate;
  }
  return best;
}

}  // namespace scree::contact
