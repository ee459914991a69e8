// Coarse search: which shells come so near each other that some of their faces or edges may touch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contact/box_grid.h"
#include "contact/shell.h"
#include "contact/wide_lanes.h"
#include "engine/base/chunks.h"
#include "engine/base/written_later.h"

namespace scree::contact {

// Shells in an order in which neighbours in space are near in memory.
template <int dim>
struct ShellTable {
  VectorWrittenLater<Shell<dim>> shells;
  BoxGrid<dim> grid;
};

template <int dim>
ShellTable<dim> make_shells(const Surface<dim>& surface, const ShellOptions& options);

// Two shells, and of each the heights of its vertices above the planes of the other.
template <int dim>
struct ShellPair {
  std::uint32_t first_place;
  std::uint32_t second_place;
  const Shell<dim>& first;
  const Shell<dim>& second;
  float rounding;  // no height is off by more [m]
  // Of vertex v of both: in the low half of the second's above the planes of the first, in the high half of the first's above
  // those of the second, a lane for every plane.
  std::array<WideLanes, dim + 1> heights;
};

// Do the planes of one of the two part them by more than a distance?
template <int dim>
SCREE_INLINE bool parted(const ShellPair<dim>& pair, float distance) {
  WideLanes lowest = pair.heights[0];
  for (int v = 1; v <= dim; ++v) lowest = least(lowest, pair.heights[v]);
  return bits(lowest > distance) != 0;
}

template <int dim>
SCREE_INLINE std::array<WideLanes, dim + 1> heights_above_each_other(const Shell<dim>& first, const Shell<dim>& second,
                                                                     const Way<dim>& way) {
  const WideLanes offsets = joined(first.offsets, second.offsets);
  std::array<WideLanes, dim + 1> heights;
  heights.fill(-offsets);
  for (int i = 0; i < dim; ++i) {
    const WideLanes normals = joined(first.normals[i], second.normals[i]);
    const WideLanes vertices = joined(second.at[i] + way.axes[i], first.at[i] - way.axes[i]);
    for_each_constant<dim + 1>([&](auto v) SCREE_INLINED { heights[v] += normals * in_halves<v>(vertices); });
  }
  return heights;
}

// Calls visit(pair) for every shell of another block, of those at some places, that no plane parts from the one at `place` by
// more than what touches may be apart.
template <int dim, class Visit>
SCREE_INLINE void for_each_near(const ShellTable<dim>& table, std::uint32_t place, const std::vector<std::uint32_t>& places,
                                const Visit& visit) {
  const Shell<dim>& own = table.shells[place];
  for (const auto other_place : places) {
    const Shell<dim>& other = table.shells[other_place];
    if (own.block == other.block) continue;
    const Way<dim> way(own, other);
    const ShellPair<dim> pair{place, other_place, own, other, way.rounding, heights_above_each_other(own, other, way)};
    if (!parted(pair, slack(own, other) + way.rounding)) visit(pair);
  }
}

// Calls visit(pair, found) once for every two shells of two blocks that no plane of theirs parts by more than what touches may
// be apart; it is SCREE_INLINED. What it leaves in `found`, which begins as `Found()`, is handed to keep(chunk number, found)
// at the end of every chunk. On all threads; the pairs of a chunk come one after the other and always in the same order.
template <class Found, int dim, class Visit, class Keep>
void visit_near(const ShellTable<dim>& table, const Visit& visit, const Keep& keep) {
  for_chunks(table.shells.size(), [&](Chunk chunk) {
    std::vector<std::uint32_t> places;
    Found found;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const auto place = static_cast<std::uint32_t>(i);
      table.grid.find(place, places);
      widely([&]() SCREE_INLINED {
        for_each_near(table, place, places, [&](const ShellPair<dim>& pair) SCREE_INLINED { visit(pair, found); });
      });
    }
    keep(chunk.number, found);
  });
}

}  // namespace scree::contact
