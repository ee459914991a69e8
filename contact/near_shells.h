// Coarse search: which shells come so near each other that some of their faces or edges may touch.
#pragma once

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
  // The heights are left to be filled in.
  ShellPair(const ShellTable<dim>& table, std::uint32_t one, std::uint32_t other)
      : first_place(one), second_place(other), first(table.shells[one]), second(table.shells[other]) {}

  std::uint32_t first_place;
  std::uint32_t second_place;
  const Shell<dim>& first;
  const Shell<dim>& second;
  Heights<dim> above_first;  // those beyond the number of faces are unused
  Heights<dim> above_second;
};

// What touches is nearer than this: a semi-edge may touch in place of its edge.
template <int dim>
double slack(const Shell<dim>& a, const Shell<dim>& b) {
  constexpr double margin = 1 + 1e-9;  // so that rounding dismisses nothing that touches
  return margin * std::max(a.reach + a.shift, b.reach + b.shift);
}

// Calls visit(chunk number, pair) once for every two shells of two blocks that no plane of theirs parts by more than what
// touches may be apart. On all threads; the pairs of a chunk come one after the other and always in the same order.
template <int dim, class Visit>
void visit_near(const ShellTable<dim>& table, const Visit& visit) {
  for_chunks(table.shells.size(), [&](Chunk chunk) {
    std::vector<std::uint32_t> found;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const Shell<dim>& own = table.shells[i];
      table.grid.find(static_cast<std::uint32_t>(i), found);
      for (const auto j : found) {
        const Shell<dim>& other = table.shells[j];
        if (own.block == other.block) continue;
        const double distance = slack(own, other);
        ShellPair<dim> pair(table, static_cast<std::uint32_t>(i), j);
        if (!heights_within(own, other, distance, pair.above_first)) continue;
        if (heights_within(other, own, distance, pair.above_second)) visit(chunk.number, pair);
      }
    }
  });
}

}  // namespace scree::contact
