// Which edges of two shells come so near, and lie so, that they may touch: by the heights of their vertices.
#pragma once

#include <algorithm>
#include <array>

#include "contact/edge_bounds.h"
#include "contact/near_shells.h"
#include "contact/touch.h"

namespace scree::contact {

// No edge of a shell rises by more above a plane that leans as little as touch_edge allows.
inline float allowed_rise(const Shell<3>& shell, float rounding) {
  return flat_sine_bound * 2 * shell.radius + 2 * rounding;
}

// Of each pair of shells the pairs of edges that stand out along the gap, each away from the other: the normals of the faces at
// an edge lean to either side of the other edge (the arc between them on the sphere of directions meets its great circle), or
// nearly. The cross product of the two edges, that of the first's edge first, points from the first to the second or back.
template <class Wide>
SCREE_INLINE std::array<EdgePairs, ShellPairs<3, Wide>::most> standing_out(const ShellPairs<3, Wide>& pairs) {
  // Heights above the planes of the first are those of the second's edges.
  const Wide allowed = in_halves<Wide>([&](int k) SCREE_INLINED { return allowed_rise(pairs.second(k), pairs.rounding(k)); },
                                       [&](int k) SCREE_INLINED { return allowed_rise(pairs.first, pairs.rounding(k)); });
  std::array<unsigned, 6> along, against;
  for (int e = 0; e < 6; ++e) {
    const Wide rise = pairs.heights[element_edges[e].end] - pairs.heights[element_edges[e].start];
    along[e] = bits(at_most(-allowed, rise));
    against[e] = bits(at_most(rise, allowed));
  }
  std::array<EdgePairs, ShellPairs<3, Wide>::most> standing{};
  pairs.for_each([&](auto k) SCREE_INLINED {
    EdgePairs first_along = 0, first_against = 0, second_along = 0, second_against = 0;
    for_each_constant<6>([&](auto e) SCREE_INLINED {
      const unsigned to = along[e] >> 8 * k, back = against[e] >> 8 * k;
      const EdgeSenses out_of_first = edges_leaning[to & 0xfu][back & 0xfu];
      const EdgeSenses out_of_second = edges_leaning[to >> lane_count & 0xfu][back >> lane_count & 0xfu];
      first_along |= spread[out_of_first.along] << e;
      first_against |= spread[out_of_first.against] << e;
      second_along |= EdgePairs{out_of_second.along} << 6 * e;
      second_against |= EdgePairs{out_of_second.against} << 6 * e;
    });
    standing[k] = (first_along & second_along) | (first_against & second_against);
  });
  return standing;
}

// Of each pair of shells the pairs of edges that are known to end in one corner, and so do not touch.
template <class Wide>
SCREE_INLINE std::array<EdgePairs, ShellPairs<3, Wide>::most> ending_together(const ShellPairs<3, Wide>& pairs) {
  constexpr float axis = 0.57F * static_cast<float>(same_corner);  // less than the root of a third
  const Wide most_apart = in_eights<Wide>(
      [&](int k) SCREE_INLINED { return axis * std::min(pairs.first.length, pairs.second(k).length) - pairs.rounding(k); });
  std::array<Wide, 3> seconds;
  for (int i = 0; i < 3; ++i) {
    seconds[i] = in_eights<Wide>([&](int k) SCREE_INLINED {
      return pairs.second(k).at[i] + static_cast<float>(pairs.second(k).centre[i] - pairs.first.centre[i]);
    });
  }
  std::array<EdgePairs, ShellPairs<3, Wide>::most> together{};
  // Two vertices of the first at once, in halves.
  for_each_constant<2>([&](auto two) SCREE_INLINED {
    unsigned there = ~0u;  // those of the second that are at their places
    for (int i = 0; i < 3; ++i) {
      const Wide firsts = in_halves<Wide>([&](int) SCREE_INLINED { return float{pairs.first.at[i][2 * two]}; },
                                          [&](int) SCREE_INLINED { return float{pairs.first.at[i][2 * two + 1]}; });
      there &= bits(at_most(absolute(seconds[i] - firsts), most_apart));
    }
    pairs.for_each([&](auto k) SCREE_INLINED {
      const unsigned even = there >> 8 * k, odd = even >> lane_count;
      together[k] |= (pairs_of_first(edges_at[1u << 2 * two]) & pairs_of_second(edges_at[even & 0xfu])) |
                     (pairs_of_first(edges_at[2u << 2 * two]) & pairs_of_second(edges_at[odd & 0xfu]));
    });
  });
  return together;
}

// Of each pair of shells the pairs of edges that may touch.
template <class Wide>
SCREE_INLINE std::array<EdgePairs, ShellPairs<3, Wide>::most> near_edges(const ShellPairs<3, Wide>& pairs) {
  // A semi-edge that touches is within reach and shift of the other shell, and its edge within one more shift.
  const auto distance = [&](int k) SCREE_INLINED {
    return slack(pairs.first, pairs.second(k)) + std::max(pairs.first.shift, pairs.second(k).shift) + pairs.rounding(k);
  };
  const auto distances = in_eights<Wide>(distance);
  std::array<unsigned, 4> beyond;  // of each plane the vertices that are too far beyond it
  for (int t = 0; t < 4; ++t) beyond[t] = bits(below(distances, pairs.by_plane[t]));
  // The edges that lie so far beyond a plane as a whole.
  const auto edges_beyond = [&](int four) SCREE_INLINED {
    const int shift = lane_count * four;
    return edges_among[beyond[0] >> shift & 0xfu] | edges_among[beyond[1] >> shift & 0xfu] |
           edges_among[beyond[2] >> shift & 0xfu] | edges_among[beyond[3] >> shift & 0xfu];
  };
  std::array<EdgePairs, ShellPairs<3, Wide>::most> near{};
  bool asked = false;
  pairs.for_each([&](auto k) SCREE_INLINED {
    near[k] = pairs_of_first(edges_of_faces[pairs.first.faces] & ~edges_beyond(2 * k + 1)) &
              pairs_of_second(edges_of_faces[pairs.second(k).faces] & ~edges_beyond(2 * k));
    asked |= near[k] != 0 && pairs.second(k).whole;
  });
  // Corners are rarely one but beside faces that are.
  if (pairs.first.open != pairs.first.faces) {
    const auto together = ending_together(pairs);
    pairs.for_each([&](auto k) SCREE_INLINED { near[k] &= ~together[k]; });
  }
  // Both must stand out from the whole of their blocks.
  if (!asked || !pairs.first.whole) return near;
  const auto standing = standing_out(pairs);
  pairs.for_each([&](auto k) SCREE_INLINED { near[k] &= pairs.second(k).whole ? standing[k] : ~EdgePairs{0}; });
  return near;
}

}  // namespace scree::contact
