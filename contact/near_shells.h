// Coarse search: which shells come so near each other that some of their faces or edges may touch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contact/box_grid.h"
#include "contact/shell.h"
#include "engine/base/chunks.h"

namespace scree::contact {

// Shells in an order in which neighbours in space are near in memory.
template <int dim>
struct ShellTable {
  std::vector<Shell<dim>> shells;
  BoxGrid<dim> grid;
};

template <int dim>
ShellTable<dim> make_shells(const Surface<dim>& surface, const ShellOptions& options);

// Two shells and the heights of the vertices of the one above the planes of the other.
template <int dim>
struct ShellPair {
  std::uint32_t first_place;
  std::uint32_t second_place;
  const Shell<dim>& first;
  const Shell<dim>& second;
  Way<dim> way;              // from the first to the second
  Heights<dim> above_first;  // of the second's vertices
  Heights<dim> above_second;
};

// What touches is nearer than this: a semi-edge may touch in place of its edge.
template <int dim>
float slack(const Shell<dim>& a, const Shell<dim>& b) {
  return std::max(a.reach + a.shift, b.reach + b.shift);
}

// Calls visit(chunk number, pair) once for every two shells of two blocks that no plane of theirs parts by more than what
// touches may be apart. On all threads; the pairs of a chunk come one after the other and always in the same order.
template <int dim, class Visit>
void visit_near(const ShellTable<dim>& table, const Visit& visit) {
  for_chunks(table.shells.size(), [&](Chunk chunk) {
    std::vector<std::uint32_t> found;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const auto place = static_cast<std::uint32_t>(i);
      const Shell<dim>& own = table.shells[i];
      table.grid.find(place, found);
      for (const auto j : found) {
        const Shell<dim>& other = table.shells[j];
        if (own.block == other.block) continue;
        const Way<dim> way(own, other);
        const float distance = slack(own, other) + way.rounding;
        const Heights<dim> above_own = heights_above<dim>(own, vertices_from(other, way));
        if (all_beyond_one(above_own, distance)) continue;
        const Heights<dim> above_other = heights_above<dim>(other, vertices_back(own, way));
        if (all_beyond_one(above_other, distance)) continue;
        visit(chunk.number, ShellPair<dim>{place, j, own, other, way, above_own, above_other});
      }
    }
  });
}

}  // namespace scree::contact
