#include "engine/packing/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::packing {

namespace {

using Eigen::Vector2d;

constexpr int lines_per_block = 4;
constexpr int most_lines = 1024;  // along a side

// The part of a vertical line that is in a convex piece.
std::optional<Interval> inside(const PlacedPiece& piece, const Vector2d& place) {
  Interval part{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t f = 0; f < piece.normals.size(); ++f) {
    const Eigen::Vector3d& normal = piece.normals[f];
    const Eigen::Vector3d& corner = piece.vertices[piece.piece->faces[f].corners[0]];
    const double beyond = normal.head<2>().dot(place - corner.head<2>());
    if (normal.z() == 0) {
      if (beyond > 0) return std::nullopt;
      continue;
    }
    const double height = corner.z() - beyond / normal.z();
    (normal.z() > 0 ? part.high : part.low) = normal.z() > 0 ? std::min(part.high, height) : std::max(part.low, height);
  }
  if (!(part.high > part.low)) return std::nullopt;
  return part;
}

void join(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::vector<Interval> joined;
  for (const Interval& next : intervals) {
    if (!joined.empty() && next.low <= joined.back().high) {
      joined.back().high = std::max(joined.back().high, next.high);
    } else {
      joined.push_back(next);
    }
  }
  intervals = std::move(joined);
}

double mean_size(const mesh::BlockMesh<3>& mesh, const std::vector<bool>& counts) {
  double volume = 0;
  double blocks = 0;
  for (const BlockId id : mesh.blocks.ids()) {
    if (!counts[id.index()]) continue;
    for (const ElementId element : mesh.blocks[id].elements) volume += mesh::element_volume(mesh, element);
    ++blocks;
  }
  return blocks > 0 ? std::cbrt(volume / blocks) : 0;
}

// From the grid's directions to the axes.
Eigen::Matrix2d turn() {
  static const Eigen::Matrix2d turn = Eigen::Rotation2Dd(std::atan((1 + std::sqrt(5)) / 2)).toRotationMatrix();
  return turn;
}

Vector2d along_grid(const Vector2d& place) {
  return turn().transpose() * place;
}

// How far a part reaches along the grid's directions [m].
Aabb<2> reach_of(const Part& part) {
  Aabb<2> reach;
  for (const Eigen::Vector3d& vertex : part.placed.vertices) reach.extend(along_grid(vertex.head<2>()));
  return reach;
}

// Without lines where so few are too wide for blocks.
Columns empty_grid(const Aabb<2>& pile, double size) {
  Columns columns;
  columns.size = size;
  const double extent = pile.sizes().maxCoeff() + 4 * size;
  columns.spacing = std::max(size / lines_per_block, extent / most_lines);
  if (columns.spacing > size / 2) return columns;
  columns.side = static_cast<int>(std::ceil(extent / columns.spacing));
  const Vector2d low = pile.center() - Vector2d::Constant(columns.spacing * (columns.side - 1) / 2);
  for (int j = 0; j < columns.side; ++j) {
    for (int i = 0; i < columns.side; ++i) {
      Column column;
      column.place = turn() * (low + columns.spacing * Vector2d(i, j));
      columns.lines.push_back(std::move(column));
    }
  }
  return columns;
}

void enter(const Part& part, Columns& columns) {
  const Aabb<2> reach = reach_of(part);
  const Vector2d from = along_grid(columns.lines.front().place);
  const auto index = [&](double at, int axis) { return (at - from[axis]) / columns.spacing; };
  // Between the first column and one behind the last, or from one before the first: a part may be anywhere.
  const auto first = [&](int axis) {
    return static_cast<int>(std::clamp<double>(std::ceil(index(reach.min()[axis], axis)), 0, columns.side));
  };
  const auto last = [&](int axis) {
    return static_cast<int>(std::clamp<double>(std::floor(index(reach.max()[axis], axis)), -1, columns.side - 1));
  };
  for (int j = first(1); j <= last(1); ++j) {
    for (int i = first(0); i <= last(0); ++i) {
      Column& column = columns.lines[static_cast<std::size_t>(j) * columns.side + i];
      if (const auto interval = inside(part.placed, column.place))
        (part.fixed ? column.fixed : column.free).push_back(*interval);
    }
  }
}

// Highest point of the free blocks on the lines within half a block's size; nothing if there is none, or in a fixed block.
std::vector<std::optional<double>> highest_near(const Columns& columns) {
  std::vector<std::optional<double>> highest(columns.lines.size());
  for (std::size_t i = 0; i < columns.lines.size(); ++i) {
    for (const std::size_t near : columns.near(i, columns.size / 2)) {
      const auto& free = columns.lines[near].free;
      if (!free.empty()) highest[i] = std::max(highest[i].value_or(free.back().high), free.back().high);
    }
  }
  return highest;
}

bool in_the_way(const std::vector<Interval>& fixed, double height) {
  return std::any_of(fixed.begin(), fixed.end(), [&](const Interval& at) { return at.low < height && at.high >= height; });
}

// Closing the height map by a disc of half a block's size: a line through a pore has the top of what is around it, and the
// pile ends where its blocks end.
void close_tops(Columns& columns, double lowest) {
  const auto highest = highest_near(columns);
  const auto blocked = [&](std::size_t i) { return highest[i] && in_the_way(columns.lines[i].fixed, *highest[i]); };
  for (std::size_t i = 0; i < columns.lines.size(); ++i) {
    if (!highest[i] || blocked(i)) continue;
    Column& column = columns.lines[i];
    column.top = highest[i];
    for (const std::size_t near : columns.near(i, columns.size / 2)) {
      if (blocked(near)) continue;
      if (!highest[near]) {
        column.top.reset();
        break;
      }
      column.top = std::min(*column.top, *highest[near]);
    }
    column.floor = lowest;
    for (const Interval& fixed : column.fixed) {
      if (column.top && fixed.high < *column.top) column.floor = fixed.high;
    }
  }
}

}  // namespace

std::vector<std::size_t> Columns::near(std::size_t index, double distance) const {
  const int reach = static_cast<int>(distance / spacing);
  const int row = static_cast<int>(index) / side;
  const int place = static_cast<int>(index) % side;
  std::vector<std::size_t> found;
  for (int j = std::max(0, row - reach); j <= std::min(side - 1, row + reach); ++j) {
    for (int i = std::max(0, place - reach); i <= std::min(side - 1, place + reach); ++i) {
      if (std::hypot(i - place, j - row) * spacing > distance) continue;
      found.push_back(static_cast<std::size_t>(j) * side + i);
    }
  }
  return found;
}

std::optional<std::size_t> Columns::nearest(const Eigen::Vector2d& place) const {
  if (lines.empty()) return std::nullopt;
  const Vector2d cell = along_grid(place - lines.front().place) / spacing + Vector2d::Constant(0.5);
  if (cell.minCoeff() < 0 || cell.maxCoeff() >= side) return std::nullopt;
  return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(side) + static_cast<std::size_t>(cell.x());
}

Columns cut_by_lines(const mesh::BlockMesh<3>& upright, const PieceSet& pieces, const std::vector<BlockId>& left_out) {
  std::vector<bool> counts(upright.blocks.size());
  for (const BlockId id : upright.blocks.ids()) counts[id.index()] = !upright.bodies[upright.blocks[id].body].fixed;
  for (const BlockId id : left_out) counts[id.index()] = false;
  Aabb<2> pile;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Part& part : pieces.parts) {
    if (!counts[part.block.index()]) continue;
    pile.extend(reach_of(part));
    lowest = std::min(lowest, part.box.min().z());
  }
  if (pile.isEmpty()) return {};
  Columns columns = empty_grid(pile, mean_size(upright, counts));
  if (columns.lines.empty()) return columns;
  for (const Part& part : pieces.parts) {
    if (part.fixed || counts[part.block.index()]) enter(part, columns);
  }
  for (Column& column : columns.lines) {
    join(column.free);
    join(column.fixed);
  }
  close_tops(columns, lowest);
  return columns;
}

}  // namespace scree::packing
