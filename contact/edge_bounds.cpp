#include "contact/edge_bounds.h"

#include <bit>
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

Lanes root(const Lanes& square) {
  Lanes root;
  for (int i = 0; i < lane_count; ++i) root[i] = std::sqrt(square[i]);
  return root;
}

// The vertices of element_edges by groups of four; the last two lanes repeat the first edge.
struct EdgeLanes {
  LaneMask start, end;
  std::array<LaneMask, 2> beside;
};
constexpr EdgeLanes lanes_of(const std::array<int, 4>& numbers) {
  const auto lanes = [&](auto vertex) {
    return LaneMask{vertex(element_edges[numbers[0]]), vertex(element_edges[numbers[1]]), vertex(element_edges[numbers[2]]),
                    vertex(element_edges[numbers[3]])};
  };
  return EdgeLanes{lanes([](const ElementEdge& edge) { return edge.start; }),
                   lanes([](const ElementEdge& edge) { return edge.end; }),
                   {lanes([](const ElementEdge& edge) { return edge.beside[0]; }),
                    lanes([](const ElementEdge& edge) { return edge.beside[1]; })}};
}
constexpr std::array<EdgeLanes, 2> edge_lanes{lanes_of({0, 1, 2, 3}), lanes_of({4, 5, 0, 0})};

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

EdgeBounds::EdgeBounds(const Shell<3>& first, const Shell<3>& second, double indentation)
    : kept_(static_cast<float>(1 - indentation)), moved_(static_cast<float>(indentation / 3)) {
  const Way<3> way(first, second);
  const float unit = 1 / first.radius;
  distance_ = unit * slack(first, second);
  off_ = 2 * unit * way.rounding;
  second_ = vertices_from(second, way);
  for (int axis = 0; axis < 3; ++axis) {
    second_[axis] *= unit;
    const Lanes at = unit * first.at[axis];
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      // The face beside vertex i has the other one as its third corner.
      const Lanes start = shuffled(at, edge_lanes[g].start), way_of = shuffled(at, edge_lanes[g].end) - start;
      groups_[g].starts[axis] = start;
      groups_[g].ways[axis] = way_of;
      groups_[g].shifts[0][axis] = moved_ * (way_of + shuffled(at, edge_lanes[g].beside[1]) - start);
      groups_[g].shifts[1][axis] = moved_ * (way_of + shuffled(at, edge_lanes[g].beside[0]) - start);
    }
  }
  for (Group& group : groups_) {
    group.squares = dot<3>(group.ways, group.ways);
    group.lengths = root(group.squares);
  }
}

EdgeBounds::Edge EdgeBounds::edge_of_second(const ElementEdge& edge) const {
  Edge seen{};
  for (int axis = 0; axis < 3; ++axis) {
    const Lanes& at = second_[axis];
    seen.start[axis] = at[edge.start];
    seen.way[axis] = at[edge.end] - at[edge.start];
    seen.square += seen.way[axis] * seen.way[axis];
    for (int i = 0; i < 2; ++i) {
      seen.shifts[i][axis] = moved_ * (seen.way[axis] + at[edge.beside[1 - i]] - at[edge.start]);
    }
  }
  seen.length = std::sqrt(seen.square);
  return seen;
}

EdgeBounds::Touching EdgeBounds::may_touch(unsigned some, const ElementEdge& of_second) const {
  const Edge edge = edge_of_second(of_second);
  Touching touching;
  for (unsigned g = 0; g < groups_.size(); ++g) {
    const unsigned of_group = some >> lane_count * g & 15u;
    if (of_group != 0) add(groups_[g], lane_count * g, of_group, edge, touching);
  }
  return touching;
}

// The fractions along both edges are line_crossing's, times the square of the common normal. A semi-edge crosses the other edge
// between the ends of both, seen along the normal.
void EdgeBounds::add(const Group& group, unsigned first_bit, unsigned some, const Edge& edge, Touching& touching) const {
  const auto& a = group.ways;
  const LanePoints<3> b{all_lanes(edge.way[0]), all_lanes(edge.way[1]), all_lanes(edge.way[2])};
  const LanePoints<3> between{edge.start[0] - group.starts[0], edge.start[1] - group.starts[1],
                              edge.start[2] - group.starts[2]};
  const LanePoints<3> normal = cross(a, b);
  const Lanes square = dot<3>(normal, normal), squares = group.squares * edge.square;
  const Lanes volume = dot<3>(between, normal);
  constexpr float least_square = 0.99F * static_cast<float>(least_crossing_sine * least_crossing_sine);
  // The square of a sum x + y is at most 1.01 x^2 + 101 y^2.
  some &= bits((volume * volume <= 1.01F * distance_ * distance_ * square + 101.0F * off_ * off_ * squares) &
               (square >= least_square * squares));
  if (some == 0) return;
  const LanePoints<3> across_a = cross(normal, a), across_b = cross(b, normal);
  const Lanes between_a = dot<3>(between, across_a), between_b = dot<3>(between, across_b);
  const Lanes off = off_ * edge.length * group.lengths;
  const Lanes off_along_a = off * edge.length, off_along_b = off * group.lengths;
  const auto within = [](const Lanes& along, const Lanes& end, const Lanes& beyond) {
    return (along >= -beyond) & (along <= end + beyond);
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& shift_a = group.shifts[i];
    const Lanes own_a = between_b - dot<3>(shift_a, across_b), edge_b = dot<3>(shift_a, across_a) - between_a;
    touching.of_first[i] |= (some & bits(within(own_a, kept_ * square, off_along_a) & within(edge_b, square, off_along_b)))
                            << first_bit;
    const LanePoints<3> shift_b{all_lanes(edge.shifts[i][0]), all_lanes(edge.shifts[i][1]), all_lanes(edge.shifts[i][2])};
    const Lanes own_b = -between_a - dot<3>(shift_b, across_a), edge_a = between_b + dot<3>(shift_b, across_b);
    touching.of_second[i] |= (some & bits(within(own_b, kept_ * square, off_along_b) & within(edge_a, square, off_along_a)))
                             << first_bit;
  }
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
