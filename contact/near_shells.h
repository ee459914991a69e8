// Coarse search: which shells come so near each other that some of their faces or edges may touch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contact/box_grid.h"
#include "contact/lanes_in.h"
#include "contact/shell.h"
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

// A shell as seen from another one, the first.
template <int dim>
struct SecondShell {
  // Of vertex v of both: in the low half of the second's above the planes of the first, in the high half of the first's above
  // those of the second, a lane for every plane.
  std::array<std::array<float, 2 * lane_count>, dim + 1> heights;
  const Shell<dim>* shell;
  std::uint32_t place;
  float rounding;  // no height is off by more [m]
};

// The first shell and some others near it, as many as there are eights of lanes.
template <int dim, class Wide>
struct ShellPairs {
  static constexpr int most = fours_of<Wide> / 2;

  SCREE_INLINE ShellPairs(std::uint32_t place, const Shell<dim>& shell) : first_place(place), first(shell) {}

  std::uint32_t first_place;
  const Shell<dim>& first;
  int count;  // of the others; behind them the last one is repeated
  std::array<const SecondShell<dim>*, most> others;
  std::array<Wide, dim + 1> heights;   // as above
  std::array<Wide, dim + 1> by_plane;  // the same of each plane, a lane for every vertex; in 2-D the last repeats the first

  // Calls visit(number of a pair, a constant) for them.
  template <class Visit>
  SCREE_INLINE void for_each(const Visit& visit) const {
    for_each_constant<most>([&](auto pair) SCREE_INLINED {
      if (pair < count) visit(pair);
    });
  }

  [[nodiscard]] SCREE_INLINE const Shell<dim>& second(int pair) const { return *others[pair]->shell; }
  [[nodiscard]] SCREE_INLINE std::uint32_t second_place(int pair) const { return others[pair]->place; }
  [[nodiscard]] SCREE_INLINE float rounding(int pair) const { return others[pair]->rounding; }
};

template <class Wide, int dim>
SCREE_INLINE std::array<Wide, dim + 1> heights_above_each_other(
    const Shell<dim>& first, const std::array<const Shell<dim>*, ShellPairs<dim, Wide>::most>& seconds,
    const std::array<Way<dim>, ShellPairs<dim, Wide>::most>& ways) {
  const Wide offsets = in_halves<Wide>([&](int) SCREE_INLINED { return first.offsets; },
                                       [&](int pair) SCREE_INLINED { return seconds[pair]->offsets; });
  std::array<Wide, dim + 1> heights;
  heights.fill(-offsets);
  for (int i = 0; i < dim; ++i) {
    const Wide normals = in_halves<Wide>([&](int) SCREE_INLINED { return first.normals[i]; },
                                         [&](int pair) SCREE_INLINED { return seconds[pair]->normals[i]; });
    const Wide vertices = in_halves<Wide>([&](int pair) SCREE_INLINED { return seconds[pair]->at[i] + ways[pair].axes[i]; },
                                          [&](int pair) SCREE_INLINED { return first.at[i] - ways[pair].axes[i]; });
    for_each_constant<dim + 1>([&](auto v) SCREE_INLINED { heights[v] += normals * in_fours<v>(vertices); });
  }
  return heights;
}

// What is found near a shell, and room for it.
template <int dim>
class NearOne {
 public:
  // Of the shells at some places those of another block that no plane parts from the one at `place` by more than what touches
  // may be apart. Without a branch for each, which no one could foretell: one that is parted is written over.
  template <class Wide>
  SCREE_INLINE void find(const ShellTable<dim>& table, std::uint32_t place, Places& places) {
    const Shell<dim>& own = table.shells[place];
    drop_own_block(table, own.block, places);
    const std::size_t count = places.size();
    if (found_.size() <= count) found_.resize(count + 1);
    SecondShell<dim>* next = found_.data();
    constexpr std::size_t together = ShellPairs<dim, Wide>::most;
    for (std::size_t i = 0; i < count; i += together) {
      std::array<std::uint32_t, together> at;
      std::array<const Shell<dim>*, together> seconds;
      std::array<Way<dim>, together> ways;
      for_each_constant<together>([&](auto k) SCREE_INLINED {
        at[k] = places[std::min(i + k, count - 1)];
        seconds[k] = &table.shells[at[k]];
        ways[k] = Way<dim>(own, *seconds[k]);
      });
      const auto heights = heights_above_each_other<Wide>(own, seconds, ways);
      Wide lowest = heights[0];
      for (int v = 1; v <= dim; ++v) lowest = least(lowest, heights[v]);
      const auto distance = [&](int k) SCREE_INLINED { return slack(own, *seconds[k]) + ways[k].rounding; };
      const unsigned parted = bits(below(in_eights<Wide>(distance), lowest));
      std::array<std::array<WideLanes, together>, dim + 1> apart;
      for (int v = 0; v <= dim; ++v) take_apart(heights[v], apart[v]);
      for_each_constant<together>([&](auto k) SCREE_INLINED {
        for (int v = 0; v <= dim; ++v) __builtin_memcpy(&next->heights[v], &apart[v][k], sizeof(WideLanes));
        next->shell = seconds[k];
        next->place = at[k];
        next->rounding = ways[k].rounding;
        next += (parted >> 8 * k & 0xffu) == 0 && i + k < count ? 1 : 0;
      });
    }
    count_ = static_cast<std::size_t>(next - found_.data());
  }

  // Calls visit(ShellPairs) for them all, in order.
  template <class Wide, class Visit>
  SCREE_INLINE void for_each(const ShellTable<dim>& table, std::uint32_t place, const Visit& visit) const {
    using Pairs = ShellPairs<dim, Wide>;
    for (std::size_t i = 0; i < count_; i += Pairs::most) {
      Pairs pairs(place, table.shells[place]);
      pairs.count = static_cast<int>(std::min<std::size_t>(Pairs::most, count_ - i));
      for (int k = 0; k < Pairs::most; ++k) {
        pairs.others[k] = &found_[i + static_cast<std::size_t>(std::min(k, pairs.count - 1))];
      }
      for (int v = 0; v <= dim; ++v) {
        std::array<WideLanes, Pairs::most> eights;
        for (int k = 0; k < Pairs::most; ++k) __builtin_memcpy(&eights[k], &pairs.others[k]->heights[v], sizeof(WideLanes));
        put_in_a_row(eights, pairs.heights[v]);
      }
      const auto& h = pairs.heights;
      const auto by_plane = transposed_fours(h[0], h[1], h[2], h[dim == 2 ? 0 : 3]);
      for (int t = 0; t <= dim; ++t) pairs.by_plane[t] = by_plane[t];
      visit(pairs);
    }
  }

 private:
  static SCREE_INLINE void drop_own_block(const ShellTable<dim>& table, BlockId block, Places& places) {
    std::size_t kept = 0;
    for (const std::uint32_t place : places) {
      places[kept] = place;
      kept += table.shells[place].block == block ? 0 : 1;
    }
    places.resize(kept);
  }

  std::vector<SecondShell<dim>> found_;
  std::size_t count_ = 0;
};

// Calls visit(pairs, found) with every two shells of two blocks once that no plane of theirs parts by more than what touches
// may be apart; it is SCREE_INLINED. What it leaves in `found`, which begins as `Found()`, is handed to keep(chunk number,
// found) at the end of every chunk. On all threads; the pairs of a chunk come one after the other and always in the same order.
template <class Found, int dim, class Visit, class Keep>
void visit_near(const ShellTable<dim>& table, const Visit& visit, const Keep& keep) {
  for_chunks(table.shells.size(), [&](Chunk chunk) {
    Places places;
    NearOne<dim> near;
    Found found;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const auto place = static_cast<std::uint32_t>(i);
      table.grid.find(place, places);
      widely([&](auto bytes) SCREE_INLINED {
        near.template find<LanesIn<bytes>>(table, place, places);
        near.template for_each<LanesIn<bytes>>(table, place, [&](const auto& pairs) SCREE_INLINED { visit(pairs, found); });
      });
    }
    keep(chunk.number, found);
  });
}

}  // namespace scree::contact
