#include "contact/edge_bounds.h"

#include <algorithm>
#include <cmath>

#include "contact/segment.h"
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

LanePoints<3> cross(const LanePoints<3>& a, const LanePoints<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

LanePoints<3> scaled(const LanePoints<3>& points, float unit) {
  return {unit * points[0], unit * points[1], unit * points[2]};
}

LanePoints<3> columns(const std::array<Lanes, lane_count>& rows) {
  const auto all = transposed(rows[0], rows[1], rows[2], rows[3]);
  return {all[0], all[1], all[2]};
}

// Is a place from the start to the end, or not more than `beyond` off?
LaneMask within(const Lanes& along, const Lanes& end, const Lanes& beyond) {
  return (along >= -beyond) & (along <= end + beyond);
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
unsigned standing_out(const Heights<3>& heights, const ElementEdge& edge, float allowed) {
  const Lanes rise = heights[edge.end] - heights[edge.start];
  return edges_between[bits(rise >= -allowed)][bits(rise <= allowed)];
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
  // Both must stand out from the whole of their blocks.
  const float of_first = allowed_rise(pair.first, pair.way), of_second = allowed_rise(pair.second, pair.way);
  EdgePairs out_of_first = 0, out_of_second = 0;
  for (std::size_t e = 0; e < element_edges.size(); ++e) {
    out_of_first |= spread[standing_out(pair.above_first, element_edges[e], of_second)] << e;
    out_of_second |= EdgePairs{standing_out(pair.above_second, element_edges[e], of_first)} << 6 * e;
  }
  return near & out_of_first & out_of_second;
}

EdgeBounds::Rows::Rows(const LanePoints<3>& vertices) : at(transposed(vertices[0], vertices[1], vertices[2], Lanes{})) {
  for (std::size_t from = 0; from < ways.size(); ++from) {
    for (std::size_t to = 0; to < at.size(); ++to) ways[from][to] = at[to] - at[from];
  }
}

// The third corner of the face beside an edge is no further from its start than two radii.
EdgeBounds::EdgeBounds(const Shell<3>& first, const Shell<3>& second, const Way<3>& way, float unit, float indentation)
    : first_(scaled(first.at, unit)),
      second_(scaled(vertices_from(second, way), unit)),
      distance_(unit * slack(first, second)),
      off_(2 * unit * way.rounding),
      kept_(1 - indentation),
      moved_(indentation / 3),
      aside_(2 * moved_ * unit * std::max(first.radius, second.radius)) {}

EdgeBounds::Crossing EdgeBounds::crossing(const Pairs& pairs) const {
  std::array<Lanes, lane_count> first_ways, second_ways, starts;
  for (int i = 0; i < lane_count; ++i) {
    const ElementEdge &of_first = element_edges[pairs[i].of_first], &of_second = element_edges[pairs[i].of_second];
    first_ways[i] = first_.ways[of_first.start][of_first.end];
    second_ways[i] = second_.ways[of_second.start][of_second.end];
    starts[i] = second_.at[of_second.start] - first_.at[of_first.start];
  }
  const LanePoints<3> a = columns(first_ways), b = columns(second_ways), between = columns(starts);
  const LanePoints<3> normal = cross(a, b);
  Crossing lines;
  lines.square = dot<3>(normal, normal);
  lines.across_first = cross(normal, a);
  lines.across_second = cross(b, normal);
  lines.along_first = dot<3>(between, lines.across_second);
  lines.along_second = -dot<3>(between, lines.across_first);
  const Lanes a_square = dot<3>(a, a), b_square = dot<3>(b, b), volume = dot<3>(between, normal);
  const Lanes a_length = root(a_square), b_length = root(b_square), off = off_ * a_length * b_length;
  lines.off_first = off * b_length;
  lines.off_second = off * a_length;
  // Beside the place of the edges that of a semi-edge: its shift from the start times a vector across.
  const Lanes aside = aside_ * root(lines.square);
  constexpr float least_square = 0.99F * static_cast<float>(least_crossing_sine * least_crossing_sine);
  // The square of a sum x + y is at most 1.01 x^2 + 101 y^2.
  const LaneMask near_lines = volume * volume <= 1.01F * distance_ * distance_ * lines.square + 101.0F * off * off;
  const LaneMask crossing = lines.square >= least_square * a_square * b_square;
  lines.near = bits(near_lines & crossing & within(lines.along_first, lines.square, lines.off_first + aside * b_length) &
                    within(lines.along_second, lines.square, lines.off_second + aside * a_length));
  return lines;
}

// The fractions along both edges are line_crossing's, times the square of the common normal. A semi-edge crosses the other edge
// between the ends of both, seen along the normal: its start is moved by a share of the way along its edge, which moves it by
// as much along the edge and not across it, and by the same share of the way to the third corner of its face.
EdgeBounds::Touching EdgeBounds::may_touch(const Pairs& pairs) const {
  const Crossing lines = crossing(pairs);
  Touching touching;
  if (lines.near == 0) return touching;
  const Lanes moved_along = moved_ * lines.square, kept = kept_ * lines.square;
  for (std::size_t k = 0; k < 2; ++k) {
    std::array<Lanes, lane_count> first_thirds, second_thirds;
    for (int i = 0; i < lane_count; ++i) {
      // The face beside one of the two vertices has the other one as its third corner.
      const ElementEdge &of_first = element_edges[pairs[i].of_first], &of_second = element_edges[pairs[i].of_second];
      first_thirds[i] = first_.ways[of_first.start][of_first.beside[1 - k]];
      second_thirds[i] = second_.ways[of_second.start][of_second.beside[1 - k]];
    }
    const LanePoints<3> a = columns(first_thirds), b = columns(second_thirds);
    const Lanes own_first = lines.along_first - moved_along - moved_ * dot<3>(a, lines.across_second);
    const Lanes target_second = lines.along_second + moved_ * dot<3>(a, lines.across_first);
    touching.of_first[k] =
        lines.near & bits(within(own_first, kept, lines.off_first) & within(target_second, lines.square, lines.off_second));
    const Lanes own_second = lines.along_second - moved_along - moved_ * dot<3>(b, lines.across_first);
    const Lanes target_first = lines.along_first + moved_ * dot<3>(b, lines.across_second);
    touching.of_second[k] =
        lines.near & bits(within(own_second, kept, lines.off_second) & within(target_first, lines.square, lines.off_first));
  }
  return touching;
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
