// A packing cut by vertical lines: where each line is in free blocks, in fixed ones, in voids. Exact along the lines.
#pragma once

#include <optional>
#include <vector>

#include "engine/packing/near_pieces.h"

namespace scree::packing {

struct Interval {
  double low = 0, high = 0;  // heights [m]
};

// One vertical line; intervals ascend and do not overlap.
struct Column {
  Eigen::Vector2d place;  // across the vertical [m]
  std::vector<Interval> free;
  std::vector<Interval> fixed;
  // Of the pile: its surface, closed over pores of half a block's size, and the highest point of a fixed block below it (the
  // lowest point of the pile if there is none). Nothing beside the pile, or where a fixed block stands in the way.
  std::optional<double> top;
  double floor = 0;
};

// Lines on a square grid around the pile. It is turned against the axes by an angle whose tangent is the golden ratio, as walls
// and the rows of blocks along them are not: else whole rows of lines may lie between rows of blocks.
struct Columns {
  double size = 0;     // of a free block: cube root of the mean volume [m]
  double spacing = 0;  // of the lines: a quarter of that, up to half if that made more than 1024 lines along a side [m]
  int side = 0;        // lines along each side
  std::vector<Column> lines;

  // Lines at most `distance` from line `index`, itself included.
  [[nodiscard]] std::vector<std::size_t> near(std::size_t index, double distance) const;
  // The line nearest to a place; nothing outside the grid.
  [[nodiscard]] std::optional<std::size_t> nearest(const Eigen::Vector2d& place) const;
};

// `upright` is a placed mesh whose z axis points up, `pieces` its pieces; blocks `left_out` are not there. Without a free block
// there are no lines, nor where one lies so far from the others that too many were needed.
Columns cut_by_lines(const mesh::BlockMesh<3>& upright, const PieceSet& pieces, const std::vector<BlockId>& left_out);

}  // namespace scree::packing
