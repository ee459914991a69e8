#include "contact/edge_bounds.h"

#include <algorithm>
#include <cmath>

#include "contact/touch.h"

namespace scree::contact {

namespace {

constexpr float flat_sine = 0.018F;  // a little more than an edge may be risen above in touch_edge

using Direction = std::array<float, 3>;

float dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction cross(const Direction& a, const Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Direction minus(const Direction& a, const Direction& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Direction lane(const LanePoints<3>& points, int i) {
  return {points[0][i], points[1][i], points[2][i]};
}

// Edges that do not lie further than `distance` above one of the planes as a whole.
unsigned edges_within(const Heights<3>& heights, float distance) {
  std::array<unsigned, 4> beyond;  // planes that a vertex is too far beyond
  for (int v = 0; v < 4; ++v) beyond[v] = bits(heights[v] > distance);
  unsigned within = 0;
  for (std::size_t e = 0; e < element_edges.size(); ++e) {
    within |= ((beyond[element_edges[e].start] & beyond[element_edges[e].end]) == 0 ? 1u : 0u) << e;
  }
  return within;
}

// Edges of a tetrahedron that may stand out along a direction perpendicular to an edge of another, whose heights above the
// planes of the tetrahedron these are: the normals of their faces lean to either side of that edge (the arc between them on the
// sphere of directions meets its great circle), or are within `allowed`, a height, of being perpendicular to it.
EdgeSenses standing_out(const Heights<3>& heights, const ElementEdge& edge, float allowed) {
  const Lanes rise = heights[edge.end] - heights[edge.start];
  return edges_leaning[bits(rise >= -allowed)][bits(rise <= allowed)];
}

// No edge of a shell rises by more above a plane that leans as little as touch_edge allows.
float allowed_rise(const Shell<3>& shell, const Way<3>& way) {
  return flat_sine * 2 * shell.radius + 2 * way.rounding;
}

}  // namespace

EdgePairs near_edges(const ShellPair<3>& pair) {
  // A semi-edge that touches is within reach and shift of the other shell, and its edge within one more shift.
  const float distance = slack(pair.first, pair.second) + std::max(pair.first.shift, pair.second.shift) + pair.way.rounding;
  const unsigned first = edges_within(pair.above_second, distance) & edges_of_faces[pair.first.faces];
  const unsigned second = edges_within(pair.above_first, distance) & edges_of_faces[pair.second.faces];
  EdgePairs near = pairs_of_first(first) & pairs_of_second(second);
  if (near == 0 || !pair.first.whole || !pair.second.whole) return near;
  // Both must stand out from the whole of their blocks, and along the gap each away from the other. The cross product of their
  // directions, that of the first's edge first, points from the first to the second or back.
  const float of_first = allowed_rise(pair.first, pair.way), of_second = allowed_rise(pair.second, pair.way);
  EdgePairs first_along = 0, first_against = 0, second_along = 0, second_against = 0;
  for (std::size_t e = 0; e < element_edges.size(); ++e) {
    const EdgeSenses out_of_first = standing_out(pair.above_first, element_edges[e], of_second);
    const EdgeSenses out_of_second = standing_out(pair.above_second, element_edges[e], of_first);
    first_along |= spread[out_of_first.along] << e;
    first_against |= spread[out_of_first.against] << e;
    second_along |= EdgePairs{out_of_second.along} << 6 * e;
    second_against |= EdgePairs{out_of_second.against} << 6 * e;
  }
  return near & ((first_along & second_along) | (first_against & second_against));
}

bool may_face(const Shell<3>& owner, const ElementEdge& edge, int beside, const Shell<3>& other, const ElementEdge& target) {
  const auto way = [](const Shell<3>& shell, int from, int to) { return minus(lane(shell.at, to), lane(shell.at, from)); };
  Direction normal = cross(way(owner, edge.start, edge.end), way(other, target.start, target.end));
  const float length = std::sqrt(dot(normal, normal));
  constexpr float unsure = 1e-3F;
  const float outwards =
      dot(normal, lane(other.normals, target.beside[0])) + dot(normal, lane(other.normals, target.beside[1]));
  if (std::abs(outwards) < unsure * length) return true;
  if (outwards < 0) normal = {-normal[0], -normal[1], -normal[2]};
  if (dot(normal, lane(owner.normals, beside)) > (unsure - static_cast<float>(least_facing)) * length) return false;
  for (int i = 0; i < 2; ++i) {
    if (dot(normal, way(owner, edge.start, edge.beside[i])) < -flat_sine * length * 2 * owner.radius) return false;
    if (dot(normal, way(other, target.start, target.beside[i])) > flat_sine * length * 2 * other.radius) return false;
  }
  return true;
}

}  // namespace scree::contact
