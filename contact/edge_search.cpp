#include "contact/edge_search.h"

#include <array>
#include <bit>
#include <cmath>

#include "contact/segment.h"
#include "contact/touch.h"

namespace scree::contact {

namespace {

constexpr double margin = 1 + 1e-9;  // so that rounding dismisses nothing that touches

// Which edges of the element, one bit each, have a part within `distance` of all planes of the other shell.
unsigned near_edges(const Shell<3>& planes, const Heights<3>& heights, double distance) {
  std::array<unsigned, 4> beyond{};  // planes that a vertex is too far beyond
  for (int f = 0; f < planes.faces; ++f) {
    for (int v = 0; v < 4; ++v) beyond[v] |= (heights[f][v] > distance ? 1u : 0u) << f;
  }
  unsigned near = 0;
  for (std::size_t e = 0; e < element_edges.size(); ++e) {
    const auto& edge = element_edges[e];
    if ((beyond[edge.start] & beyond[edge.end]) != 0) continue;
    double from = 0, to = 1;
    for (unsigned left = beyond[edge.start] | beyond[edge.end]; left != 0; left &= left - 1) {
      const int f = std::countr_zero(left);
      const double at_start = heights[f][edge.start] - distance, at_end = heights[f][edge.end] - distance;
      const double crossing = at_start / (at_start - at_end);
      (at_start > 0 ? from : to) = at_start > 0 ? std::max(from, crossing) : std::min(to, crossing);
    }
    near |= (from <= to * margin ? 1u : 0u) << e;
  }
  return near;
}

// A vector for each vertex of a tetrahedron, axis by axis.
using AtVertices = std::array<std::array<double, 4>, 3>;

// Moments of an edge of one shell about the vertices of another: (vertex - start) x edge. Their differences are the common
// normals of the edge and the other's edges.
AtVertices moments(const Shell<3>& shell, const Point<3>& start, const Point<3>& edge) {
  AtVertices moments;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int v = 0; v < 4; ++v) moments[i][v] = (shell.at[j][v] - start[j]) * edge[k] - (shell.at[k][v] - start[k]) * edge[j];
  }
  return moments;
}

// On which sides of the plane through an edge that has this normal the two vertices beside it are, those apart that are within
// the rise that touch_edge allows: bit 0 for above, bit 1 for below.
unsigned sides_of(const Shell<3>& shell, const ElementEdge& edge, const Point<3>& normal, double allowed) {
  const double level = normal.dot(shell.vertex(edge.start));
  const double left = normal.dot(shell.vertex(edge.left)) - level, right = normal.dot(shell.vertex(edge.right)) - level;
  return (std::max(left, right) > allowed ? 1u : 0u) | (std::min(left, right) < -allowed ? 2u : 0u);
}

// Do two edges stand out from their blocks along the common normal? Of blocks of one tetrahedron that is a matter of the
// vertices beside them: those of the one lie on this side of the edges, those of the other on that.
bool may_stand_out(const ShellPair<3>& pair, const ElementEdge& of_first, const ElementEdge& of_second,
                   const Point<3>& normal) {
  if (!pair.first.whole || !pair.second.whole) return true;
  constexpr double rise = 0.02;  // a little more than it allows
  const double allowed = rise * normal.norm();
  const unsigned first = sides_of(pair.first, of_first, normal, allowed * pair.first.longest);
  const unsigned second = sides_of(pair.second, of_second, normal, allowed * pair.second.longest);
  return ((first & 1u) == 0 && (second & 2u) == 0) || ((first & 2u) == 0 && (second & 1u) == 0);
}

// Does the owner's face come within reach of the plane of the face beside the target edge?
bool comes_beside(const Shell<3>& owner, int face, const std::array<double, 4>& heights, double reach) {
  const auto& corners = owner.corners[face];
  const auto [low, high] = std::minmax({heights[corners[0]], heights[corners[1]], heights[corners[2]]});
  return low <= reach && high >= -reach;
}

bool boxes_meet(const Shell<3>& owner, int face, const Point<3>& start, const Point<3>& end) {
  const auto& corners = owner.corners[face];
  const Point<3> a = owner.vertex(corners[0]), b = owner.vertex(corners[1]), c = owner.vertex(corners[2]);
  for (int i = 0; i < 3; ++i) {
    if (std::min(start[i], end[i]) > std::max({a[i], b[i], c[i]}) + owner.reach) return false;
    if (std::max(start[i], end[i]) < std::min({a[i], b[i], c[i]}) - owner.reach) return false;
  }
  return true;
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

}  // namespace

// An edge of a shell's element with the semi-edges beside it, and the edge of another.
struct EdgeSearch::EdgePair {
  const Shell<3>& owner;
  const EdgeSides& own;
  const Shell<3>& other;
  const ElementEdge& target;
  int beside;  // the side of the other shell in which the target edge is searched
  const Heights<3>& above_owner;
  const Heights<3>& above_other;
};

EdgeSearch::EdgeSearch(const Surface<3>& surface, const ContactOptions& options, std::size_t shells)
    : surface_(surface), options_(options), near_(chunk_count(shells)) {}

void EdgeSearch::look_at(std::size_t chunk, const ShellPair<3>& pair) {
  // A semi-edge that touches is within reach and shift of the other shell, and its edge within one more shift.
  const double distance = slack(pair.first, pair.second) + margin * std::max(pair.first.shift, pair.second.shift);
  const unsigned first = near_edges(pair.second, pair.above_second, distance);
  if (first == 0) return;
  const unsigned second = near_edges(pair.first, pair.above_first, distance);
  const double between = margin * slack(pair.first, pair.second);
  for (std::size_t j = 0; j < 6; ++j) {
    if ((second >> j & 1u) == 0) continue;
    const ElementEdge& b = element_edges[j];
    const Point<3> start = pair.second.vertex(b.start);
    const AtVertices moment = moments(pair.first, start, pair.second.vertex(b.end) - start);
    for (std::size_t i = 0; i < 6; ++i) {
      if ((first >> i & 1u) == 0) continue;
      const ElementEdge& a = element_edges[i];
      Point<3> normal;
      for (int axis = 0; axis < 3; ++axis) normal[axis] = moment[axis][a.end] - moment[axis][a.start];
      const double gap = normal.dot(start - pair.first.vertex(a.start));
      if (gap * gap > between * between * normal.squaredNorm() || !may_stand_out(pair, a, b, normal)) continue;
      const EdgeSides &of_a = pair.first.edges[i], &of_b = pair.second.edges[j];
      look_at_sides({pair.first, of_a, pair.second, b, of_b.first, pair.above_first, pair.above_second}, near_[chunk]);
      look_at_sides({pair.second, of_b, pair.first, a, of_a.first, pair.above_second, pair.above_first}, near_[chunk]);
    }
  }
}

// The semi-edges beside the own edge.
void EdgeSearch::look_at_sides(const EdgePair& edges, std::vector<Near>& near) const {
  const auto& [owner, own, other, target, beside, above_owner, above_other] = edges;
  if (beside < 0) return;
  const Point<3> start = other.vertex(target.start), end = other.vertex(target.end);
  const double reach = margin * owner.reach;
  for (const int number : own.sides) {
    if (number < 0) continue;
    const int f = number / 3, side = number % 3;
    const double at_start = above_owner[f][target.start], at_end = above_owner[f][target.end];
    if (std::min(at_start, at_end) > reach || std::max(at_start, at_end) < -reach) continue;
    const auto& corners = owner.corners[f];
    const Point<3> from = owner.vertex(corners[side]), to = owner.vertex(corners[(side + 1) % 3]);
    const Point<3> centre = (from + to + owner.vertex(corners[(side + 2) % 3])) / 3;
    if (!may_cross(from + options_.indentation * (centre - from), to + options_.indentation * (centre - to), start, end,
                   margin * (owner.reach + owner.shift))) {
      continue;
    }
    if (!boxes_meet(owner, f, start, end)) continue;
    if (!comes_beside(owner, f, above_other[beside / 3], std::max(owner.reach, other.reach))) continue;
    near.push_back({static_cast<std::uint32_t>(owner.face(f).index() * 3 + static_cast<std::size_t>(side)),
                    surface_.face_edges[other.face(beside / 3)][beside % 3]});
  }
}

std::vector<EdgeSearch::Touching> EdgeSearch::touching(const std::vector<Near>& near,
                                                       const std::vector<FaceId>& spring_targets) const {
  std::vector<Touching> all;
  for (const auto& [semi_edge, edge] : near) {
    const FaceId own{semi_edge / 3};
    const auto side = static_cast<int>(semi_edge % 3);
    const auto touch = touch_edge(surface_, options_, own, side, edge);
    if (!touch) continue;
    const SurfaceEdge& own_edge = surface_.edges[surface_.face_edges[own][side]];
    const SurfaceEdge& other_edge = surface_.edges[edge];
    if (any_touches(surface_, spring_targets, own_edge.faces, surface_.faces[other_edge.faces[0]].block)) continue;
    if (any_touches(surface_, spring_targets, other_edge.faces, surface_.faces[own].block)) continue;
    all.push_back({semi_edge, {edge, std::abs(touch->gap), std::abs(touch->along - 0.5)}});
  }
  return all;
}

std::vector<EdgeId> EdgeSearch::targets(const std::vector<FaceId>& spring_targets) {
  std::vector<std::vector<Touching>> parts(near_.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < near_.size(); ++i) parts[i] = touching(near_[i], spring_targets);
  near_ = {};
  std::vector<Touching> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end(), [](const Touching& a, const Touching& b) { return a.semi_edge < b.semi_edge; });
  std::vector<EdgeId> targets(surface_.faces.size() * 3);
  std::vector<Candidate<EdgeId>> candidates;
  for (std::size_t i = 0; i < all.size();) {
    const std::uint32_t semi_edge = all[i].semi_edge;
    candidates.clear();
    for (; i < all.size() && all[i].semi_edge == semi_edge; ++i) candidates.push_back(all[i].candidate);
    targets[semi_edge] = choose(candidates, equal_distance * surface_.lengths[FaceId{semi_edge / 3}]);
  }
  return targets;
}

}  // namespace scree::contact
