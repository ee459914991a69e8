// Which shells the semi-springs of another may touch: by the heights of its vertices.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "contact/near_shells.h"

namespace scree::contact {

// A shell that semi-springs may touch.
struct NearShell {
  std::uint32_t place : 31;
  std::uint32_t close : 1;  // a whole face may: such shells are looked at first, and often leave the others out of the running
  float bound;              // no semi-spring is nearer [m]
};

struct NearSprings {
  std::uint32_t own;  // place of their shell
  NearShell other;
};

// Appends what the semi-springs of the one may touch of the other, and the other way round.
template <int dim>
SCREE_INLINE void add_near_springs(const ShellPair<dim>& pair, float indentation, std::vector<NearSprings>& near) {
  const auto& heights = pair.heights;
  WideLanes high = heights[0], sum = high;
  for (int v = 1; v <= dim; ++v) {
    high = most(high, heights[v]);
    sum += heights[v];
  }
  // How far each vertex, a lane each, is beyond any plane of the other shell: no less than this, and the semi-springs beside
  // it, in whichever face, no less than that. In the low half of the second, in the high half of the first. The face of a
  // semi-spring has all vertices but one.
  const WideLanes centres = indentation / dim * (sum - high);
  const auto by_plane = transposed_halves(heights[0], heights[1], heights[2], heights[dim == 2 ? 0 : 3]);
  WideLanes vertices{}, springs{};
  for_each_constant<dim + 1>([&](auto t) SCREE_INLINED {
    vertices = most(vertices, by_plane[t]);
    springs = most(springs, (1 - indentation) * by_plane[t] + in_halves<t>(centres));
  });
  const WideLanes reach = joined(pair.second.reach, pair.first.reach) + pair.rounding;
  const unsigned may_touch = bits((vertices <= reach) | (springs <= reach));
  if (may_touch == 0) return;
  // A semi-spring is no further from its vertex than the indentation times a diameter.
  const unsigned close = bits(vertices <= reach + 2 * indentation * joined(pair.second.radius, pair.first.radius));
  const auto add = [&](std::uint32_t own, std::uint32_t other, unsigned vertices_close, const Lanes& bounds) SCREE_INLINED {
    const bool all = std::popcount(vertices_close & ((2u << dim) - 1)) >= dim;
    near.push_back({own, {other & 0x7fffffffu, all ? 1u : 0u, least_lane(bounds) - pair.rounding}});
  };
  if (may_touch >> lane_count != 0) add(pair.first_place, pair.second_place, close >> lane_count, high_half(springs));
  if ((may_touch & 0xfu) != 0) add(pair.second_place, pair.first_place, close & 0xfu, low_half(springs));
}

}  // namespace scree::contact
