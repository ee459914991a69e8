// Which boxes meet which, by cells of space.
//
// Boxes are sorted into levels by size, each level four times as coarse as the one below. In its level a box is entered once,
// in the cell of its low corner, and the boxes of a level are sorted by cell, so that those of a row of cells follow one
// another in memory. A box looks into the cells of its own level and of every coarser one where the low corner of a box may lie
// that meets it. Time and memory are linear in the number of boxes. The cells repeat themselves outside
// the region where most boxes are; two cells that share a slot only cost needless tests.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/lanes.h"
#include "engine/base/geometry.h"
#include "engine/base/written_later.h"

namespace scree::contact {

using Places = VectorWrittenLater<std::uint32_t>;

template <int dim>
class BoxGrid {
 public:
  explicit BoxGrid(std::span<const Aabb<dim>> boxes);

  // Boxes in the order of their cells: neighbours in space are near in it. All below is told in places of this order.
  [[nodiscard]] const Places& order() const { return order_; }

  // Leaves in `found` the boxes that meet the one at a place. Of every two that meet, just one finds the other. A few that
  // are a ten-millionth of the scene's size apart are found, too.
  void find(std::uint32_t place, Places& found) const;

  // All that meet any box, likewise.
  void find(const Aabb<dim>& box, Places& found) const;

 private:
  // In single precision, rounded outwards: boxes meet if no low corner is above the other's high one. Lanes beyond the last
  // axis are 0. The opposite of the high one, so that one comparison asks for both.
  struct Packed {
    Lanes low{};
    Lanes below_high{};
  };
  using Cell = std::array<std::int64_t, dim>;

  struct Level {
    std::uint32_t first = 0;  // place of its first box
    std::uint32_t count = 0;
    std::array<double, dim> cells_per_metre{};
    std::array<double, dim> largest{};  // extents of its boxes [m]
    std::array<int, dim> bits{};        // of the number of cells before they repeat
    LargeVector<std::uint32_t> starts;  // of each slot, as places
  };

  static std::vector<std::vector<std::uint32_t>> by_size(std::span<const Aabb<dim>> boxes);
  void make_level(std::span<const Aabb<dim>> boxes, const std::vector<std::uint32_t>& members);
  void choose_cells(std::span<const Aabb<dim>> boxes, const std::vector<std::uint32_t>& members, Level& level) const;
  [[nodiscard]] Packed pack(const Aabb<dim>& box) const;
  [[nodiscard]] std::uint32_t slot_of(const Level& level, const Aabb<dim>& box) const;
  template <class Wide>
  void look_into(const Level& level, const Packed& box, std::uint32_t before, Places& found) const;
  template <class Wide>
  void test(std::uint32_t from, std::uint32_t to, const Wide& limits, Places& found) const;

  Point<dim> origin_ = Point<dim>::Zero();
  std::vector<Level> levels_;  // from fine to coarse
  Places order_;
  VectorWrittenLater<Packed> packed_;  // and one more, as they are read by twos
};

}  // namespace scree::contact
