#include "thermal/repeated_cells.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include "engine/base/chunks.h"

namespace scree::thermal {

namespace {

// 0.6 kB each.
constexpr std::size_t most_shapes = 4096;
constexpr int bits_of_edge = 36;
// Of the cells, each looked through by one thread, whatever the number of threads.
constexpr std::size_t stretches = 32;

// Much faster than std::llround.
std::int64_t nearest(double value) {
  return static_cast<std::int64_t>(value + (value < 0 ? -0.5 : 0.5));
}

// A cell but for its place. All of its bytes are set.
template <int dim>
struct Shape {
  std::int64_t kind = 0;
  std::int64_t exponent = 0;  // of the unit, 2^exponent m
  std::array<double, static_cast<std::size_t>(dim* dim)> conductivity{};
  std::array<std::int64_t, static_cast<std::size_t>(7 * dim)> edges{};  // from the first corner to the others, in units

  Shape(const mesh::Cell& cell, const CellPoints<dim>& points, const Tensor<dim>& tensor)
      : kind(static_cast<std::int64_t>(cell.kind)) {
    const std::size_t corners = mesh::corner_count(cell.kind);
    double size = 0;
    for (std::size_t i = 1; i < corners; ++i) size = std::max(size, (points[i] - points[0]).template lpNorm<Eigen::Infinity>());
    exponent = std::ilogb(size) - bits_of_edge;
    const double scale = std::ldexp(1, -static_cast<int>(exponent));
    for (std::size_t i = 1; i < corners; ++i) {
      for (std::size_t axis = 0; axis < dim; ++axis) {
        edges[dim * (i - 1) + axis] = nearest(scale * (points[i][axis] - points[0][axis]));
      }
    }
    std::memcpy(conductivity.data(), tensor.data(), sizeof conductivity);
  }

  [[nodiscard]] CellPoints<dim> points() const {
    CellPoints<dim> all;
    all[0].setZero();
    for (std::size_t i = 1; i < all.size(); ++i) {
      for (std::size_t axis = 0; axis < dim; ++axis) {
        all[i][axis] = std::ldexp(static_cast<double>(edges[dim * (i - 1) + axis]), static_cast<int>(exponent));
      }
    }
    return all;
  }

  // To the bit, as is hashed; there is no padding.
  friend bool operator==(const Shape& a, const Shape& b) {
    return std::memcmp(&a, &b, sizeof(Shape)) == 0;  // NOLINT(bugprone-suspicious-memory-comparison)
  }
};

template <int dim>
struct HashOfShape {
  std::size_t operator()(const Shape<dim>& shape) const {
    return std::hash<std::string_view>{}({reinterpret_cast<const char*>(&shape), sizeof shape});
  }
};

template <int dim>
typename RepeatedCells<dim>::Corners corners_of(const Shape<dim>& shape, SpaceOrder order) {
  const auto kind = static_cast<mesh::CellKind>(shape.kind);
  const Tensor<dim> conductivity(shape.conductivity.data());
  typename RepeatedCells<dim>::Corners corners;
  for (std::size_t i = 0; i < mesh::corner_count(kind); ++i) {
    corners[i] = corner_of_cell<dim>(kind, shape.points(), conductivity, static_cast<int>(i), order);
  }
  return corners;
}

// The shapes of some cells, numbered as they are met.
template <int dim>
class ShapeList {
 public:
  struct Entry {
    std::int32_t number;
    std::int32_t cells;  // that have it
  };

  // The number of the shape, which so many cells more have, or -1 if there are too many shapes.
  std::int32_t number(const Shape<dim>& shape, std::int32_t cells) {
    if (last_ == map_.end() || !(last_->first == shape)) last_ = map_.find(shape);
    if (last_ == map_.end()) {
      if (map_.size() == most_shapes) return -1;
      last_ = map_.emplace(shape, Entry{static_cast<std::int32_t>(map_.size()), 0}).first;
      in_order_.push_back(&*last_);
    }
    last_->second.cells += cells;
    return last_->second.number;
  }

  using Map = std::unordered_map<Shape<dim>, Entry, HashOfShape<dim>>;
  [[nodiscard]] const std::vector<const typename Map::value_type*>& in_order() const { return in_order_; }

 private:
  Map map_;
  std::vector<const typename Map::value_type*> in_order_;
  typename Map::iterator last_ = map_.end();
};

// Of equal length, but for the last.
std::vector<Chunk> stretches_of(std::size_t cells) {
  const std::size_t length = cells / stretches + 1;
  std::vector<Chunk> all;
  for (std::size_t i = 0; i < stretches; ++i) {
    all.push_back({i, std::min(cells, i * length), std::min(cells, (i + 1) * length)});
  }
  return all;
}

// Calls use(block, cell) for the cells of a stretch.
template <int dim, class Use>
void for_cells(const mesh::BlockMesh<dim>& mesh, Chunk stretch, const Use& use) {
  for (const BlockId block : mesh.blocks.ids()) {
    const auto& cells = mesh.blocks[block].cells;
    const std::size_t end = std::min(cells.last(), stretch.end);
    for (std::size_t cell = std::max(cells.first(), stretch.begin); cell < end; ++cell) use(block, CellId(cell));
  }
}

}  // namespace

template <int dim>
RepeatedCells<dim>::RepeatedCells(const mesh::BlockMesh<dim>& mesh, const Table<BlockId, Tensor<dim>>& conductivity,
                                  SpaceOrder order)
    : which_(mesh.cells.size(), -1) {
  if (mesh.cells.empty()) return;
  const std::vector<Chunk> parts = stretches_of(which_.size());
  std::array<ShapeList<dim>, stretches> lists;
  for_chunks(parts, [&](Chunk stretch) {
    for_cells(mesh, stretch, [&](BlockId block, CellId cell) {
      const Shape<dim> shape(mesh.cells[cell], cell_points(mesh, mesh.cells[cell]), conductivity[block]);
      which_[cell] = lists[stretch.number].number(shape, 1);
    });
  });
  ShapeList<dim> all;
  std::array<std::vector<std::int32_t>, stretches> numbers;  // in all of the shapes of each list
  for (std::size_t i = 0; i < stretches; ++i) {
    for (const auto* entry : lists[i].in_order()) numbers[i].push_back(all.number(entry->first, entry->second.cells));
  }
  std::vector<std::int32_t> kept;  // place in shapes_ of each of all
  for (const auto* entry : all.in_order()) {
    kept.push_back(entry->second.cells < 2 ? -1 : static_cast<std::int32_t>(shapes_.size()));
    if (kept.back() >= 0) shapes_.push_back(corners_of<dim>(entry->first, order));
  }
  for_chunks(parts, [&](Chunk stretch) {
    for (std::size_t cell = stretch.begin; cell < stretch.end; ++cell) {
      std::int32_t& which = which_[CellId(cell)];
      if (which >= 0) which = numbers[stretch.number][static_cast<std::size_t>(which)];
      if (which >= 0) which = kept[static_cast<std::size_t>(which)];
    }
  });
}

template class RepeatedCells<2>;
template class RepeatedCells<3>;

}  // namespace scree::thermal
