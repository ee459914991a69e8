// Which shells the semi-springs of another may touch: by the heights of its vertices.
#pragma once

#include <array>
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

// How far semi-springs are from the vertices they stand for: shares of a vertex and of each corner of its face in one.
struct Shares {
  float kept, moved;
};

// Appends what the semi-springs of the one may touch of the other, and the other way round.
template <int dim, class Wide>
SCREE_INLINE void add_near_springs(const ShellPairs<dim, Wide>& pairs, const Shares& shares, std::vector<NearSprings>& near) {
  bool open = pairs.first.open != 0;
  pairs.for_each([&](auto k) SCREE_INLINED { open |= pairs.second(k).open != 0; });
  if (!open) return;
  const auto& heights = pairs.heights;
  Wide high = heights[0], sum = high;
  for (int v = 1; v <= dim; ++v) {
    high = most(high, heights[v]);
    sum += heights[v];
  }
  // How far each vertex, a lane each, is beyond any plane of the other shell: no less than this, and the semi-springs beside
  // it, in whichever face, no less than that. In the low half of the second, in the high half of the first. The face of a
  // semi-spring has all vertices but one.
  const Wide centres = shares.moved * (sum - high);
  Wide vertices{}, springs{};
  for_each_constant<dim + 1>([&](auto t) SCREE_INLINED {
    vertices = most(vertices, pairs.by_plane[t]);
    springs = most(springs, shares.kept * pairs.by_plane[t] + in_fours<t>(centres));
  });
  const Wide rounding = in_eights<Wide>([&](int k) SCREE_INLINED { return pairs.rounding(k); });
  const Wide reach = in_halves<Wide>([&](int k) SCREE_INLINED { return pairs.second(k).reach; },
                                     [&](int) SCREE_INLINED { return pairs.first.reach; }) +
                     rounding;
  const unsigned may_touch = bits(at_most(vertices, reach) | at_most(springs, reach));
  if (may_touch == 0) return;
  // A semi-spring is no further from its vertex than the indentation times a diameter.
  const Wide radius = in_halves<Wide>([&](int k) SCREE_INLINED { return pairs.second(k).radius; },
                                      [&](int) SCREE_INLINED { return pairs.first.radius; });
  const unsigned close = bits(at_most(vertices, reach + 2 * dim * shares.moved * radius));
  const Wide bounds = least_in_fours(springs) - rounding;
  std::array<float, count_of<Wide>> bound;
  __builtin_memcpy(&bound, &bounds, sizeof bound);
  const auto add = [&](int four, const Shell<dim>& shell, std::uint32_t own, std::uint32_t other) SCREE_INLINED {
    if ((may_touch >> lane_count * four & 0xfu) == 0 || shell.open == 0) return;
    const bool all = std::popcount(close >> lane_count * four & ((2u << dim) - 1)) >= dim;
    near.push_back({own, {other & 0x7fffffffu, all ? 1u : 0u, bound[lane_count * four]}});
  };
  pairs.for_each([&](auto k) SCREE_INLINED {
    add(2 * k + 1, pairs.first, pairs.first_place, pairs.second_place(k));
    add(2 * k, pairs.second(k), pairs.second_place(k), pairs.first_place);
  });
}

}  // namespace scree::contact
