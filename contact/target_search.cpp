#include "contact/target_search.h"

#include <algorithm>
#include <array>
#include <limits>

#include "contact/candidates.h"

namespace scree::contact {

namespace {

// Distances that differ by less than this, in characteristic lengths, are equal: more than rounding, less than any gap that
// matters.
constexpr double equal_distance = 1e-6;
constexpr double equal_score = 1e-6;  // the same for the cosine or fraction that decides between them

struct Choice {
  std::size_t candidate = std::numeric_limits<std::size_t>::max();
  double score = 0;
};

// Of the candidates of each slot, the index of the one with the least distance; among those as close as it, the one with the
// lowest score, then the lowest id. `describe` tells a candidate's slot and score,
// `equal` the difference in distance that is none [m].
template <class Candidate, class Describe, class Equal>
std::vector<Choice> choose(const std::vector<Candidate>& candidates, std::size_t slots, const Describe& describe,
                           const Equal& equal) {
  std::vector<double> least(slots, std::numeric_limits<double>::infinity());
  for (const auto& candidate : candidates) {
    double& distance = least[describe(candidate).slot];
    distance = std::min(distance, candidate.distance);
  }
  std::vector<Choice> choices(slots);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto [slot, score] = describe(candidates[i]);
    if (candidates[i].distance > least[slot] + equal(slot)) continue;
    Choice& best = choices[slot];
    const bool first = best.candidate == Choice{}.candidate;
    const bool better = first || score < best.score - equal_score ||
                        (score < best.score + equal_score && candidates[i].target < candidates[best.candidate].target);
    if (better) best = {i, score};
  }
  return choices;
}

struct Described {
  std::size_t slot;
  double score;
};

template <int dim>
std::vector<FaceId> choose_faces(const Surface<dim>& surface, const std::vector<SpringCandidate>& candidates) {
  const auto choices = choose(
      candidates, surface.faces.size() * dim,
      [](const SpringCandidate& candidate) {
        return Described{candidate.spring, -candidate.facing};
      },
      [&](std::size_t spring) { return equal_distance * surface.lengths[FaceId{spring / dim}]; });
  std::vector<FaceId> targets(choices.size());
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].candidate < candidates.size()) targets[i] = candidates[choices[i].candidate].target;
  }
  return targets;
}

// Does a semi-spring of any of these faces have its target on this block?
bool any_touches(const Surface<3>& surface, const std::vector<FaceId>& spring_targets, const std::array<FaceId, 2>& faces,
                 BlockId block) {
  for (const FaceId face : faces) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const FaceId target = spring_targets[face.index() * 3 + corner];
      if (target.valid() && surface.faces[target].block == block) return true;
    }
  }
  return false;
}

std::vector<EdgeId> choose_edges(const Surface<3>& surface, std::vector<EdgeCandidate> candidates,
                                 const std::vector<FaceId>& spring_targets) {
  std::erase_if(candidates, [&](const EdgeCandidate& candidate) {
    const FaceId owner{candidate.semi_edge / 3};
    const SurfaceEdge& own = surface.edges[surface.face_edges[owner][candidate.semi_edge % 3]];
    const SurfaceEdge& other = surface.edges[candidate.target];
    return any_touches(surface, spring_targets, own.faces, surface.faces[other.faces[0]].block) ||
           any_touches(surface, spring_targets, other.faces, surface.faces[owner].block);
  });
  const auto choices = choose(
      candidates, surface.faces.size() * 3,
      [](const EdgeCandidate& candidate) {
        return Described{candidate.semi_edge, candidate.off_middle};
      },
      [&](std::size_t semi_edge) { return equal_distance * surface.lengths[FaceId{semi_edge / 3}]; });
  std::vector<EdgeId> targets(choices.size());
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].candidate < candidates.size()) targets[i] = candidates[choices[i].candidate].target;
  }
  return targets;
}

}  // namespace

template <int dim>
Targets<dim> find_targets(const Surface<dim>& surface, const ContactOptions& options) {
  Candidates candidates = find_candidates(surface, options);
  Targets<dim> targets;
  targets.of_springs = choose_faces(surface, candidates.springs);
  if constexpr (dim == 3) {
    targets.of_edges = choose_edges(surface, std::move(candidates.edges), targets.of_springs);
  }
  return targets;
}

template Targets<2> find_targets<2>(const Surface<2>&, const ContactOptions&);
template Targets<3> find_targets<3>(const Surface<3>&, const ContactOptions&);

}  // namespace scree::contact
