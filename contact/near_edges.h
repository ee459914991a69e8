// Which edges of two shells come so near, and lie so, that they may touch: by the heights of their vertices.
#pragma once

#include <algorithm>
#include <array>

#include "contact/edge_bounds.h"
#include "contact/near_shells.h"

namespace scree::contact {

// The edges of two shells, one bit each.
struct EdgesOfPair {
  unsigned of_first, of_second;
};

// Those that do not lie further than `distance` above one of the other's planes as a whole.
SCREE_INLINE EdgesOfPair edges_within(const ShellPair<3>& pair, float distance) {
  std::array<unsigned, 4> beyond;  // planes that a vertex is too far beyond, the first's lowest
  for (int v = 0; v < 4; ++v) beyond[v] = bits(pair.heights[v] > distance);
  EdgesOfPair within{};
  for (unsigned e = 0; e < element_edges.size(); ++e) {
    const unsigned planes = beyond[element_edges[e].start] & beyond[element_edges[e].end];
    within.of_second |= (planes & 0xfu) == 0 ? 1u << e : 0u;
    within.of_first |= (planes & 0xf0u) == 0 ? 1u << e : 0u;
  }
  return within;
}

// No edge of a shell rises by more above a plane that leans as little as touch_edge allows.
inline float allowed_rise(const Shell<3>& shell, float rounding) {
  return flat_sine_bound * 2 * shell.radius + 2 * rounding;
}

// Pairs that stand out along the gap, each away from the other: the normals of the faces at an edge lean to either side of the
// other edge (the arc between them on the sphere of directions meets its great circle), or nearly. The cross product of the two
// edges, that of the first's edge first, points from the first to the second or back.
SCREE_INLINE EdgePairs standing_out(const ShellPair<3>& pair) {
  // Heights above the planes of the first are those of the second's edges.
  const WideLanes allowed = joined(allowed_rise(pair.second, pair.rounding), allowed_rise(pair.first, pair.rounding));
  EdgePairs first_along = 0, first_against = 0, second_along = 0, second_against = 0;
  for_each_constant<6>([&](auto e) SCREE_INLINED {
    const WideLanes rise = pair.heights[element_edges[e].end] - pair.heights[element_edges[e].start];
    const unsigned along = bits(rise >= -allowed), against = bits(rise <= allowed);
    const EdgeSenses out_of_first = edges_leaning[along & 0xfu][against & 0xfu];
    const EdgeSenses out_of_second = edges_leaning[along >> 4][against >> 4];
    first_along |= spread[out_of_first.along] << e;
    first_against |= spread[out_of_first.against] << e;
    second_along |= EdgePairs{out_of_second.along} << 6 * e;
    second_against |= EdgePairs{out_of_second.against} << 6 * e;
  });
  return (first_along & second_along) | (first_against & second_against);
}

SCREE_INLINE EdgePairs near_edges(const ShellPair<3>& pair) {
  // A semi-edge that touches is within reach and shift of the other shell, and its edge within one more shift.
  const float distance = slack(pair.first, pair.second) + std::max(pair.first.shift, pair.second.shift) + pair.rounding;
  const EdgesOfPair edges = edges_within(pair, distance);
  const EdgePairs near = pairs_of_first(edges.of_first & edges_of_faces[pair.first.faces]) &
                         pairs_of_second(edges.of_second & edges_of_faces[pair.second.faces]);
  // Both must stand out from the whole of their blocks.
  return near == 0 || !pair.first.whole || !pair.second.whole ? near : near & standing_out(pair);
}

}  // namespace scree::contact
