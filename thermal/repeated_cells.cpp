#include "thermal/repeated_cells.h"

#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace scree::thermal {

namespace {

// 0.6 kB each.
constexpr std::size_t most_shapes = 4096;
constexpr int bits_of_edge = 36;

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

// The shapes of a mesh, numbered as they are met.
template <int dim>
class ShapeList {
 public:
  struct Entry {
    std::int32_t number;
    std::int32_t cells;  // that have it
  };
  using Map = std::unordered_map<Shape<dim>, Entry, HashOfShape<dim>>;

  // The number of the cell's shape, or -1 if there are too many.
  std::int32_t number(const Shape<dim>& shape) {
    if (last_ == shapes_.end() || !(last_->first == shape)) last_ = shapes_.find(shape);
    if (last_ == shapes_.end()) {
      if (shapes_.size() == most_shapes) return -1;
      last_ = shapes_.emplace(shape, Entry{static_cast<std::int32_t>(shapes_.size()), 0}).first;
    }
    ++last_->second.cells;
    return last_->second.number;
  }

  [[nodiscard]] const Map& shapes() const { return shapes_; }

 private:
  Map shapes_;
  typename Map::iterator last_ = shapes_.end();
};

}  // namespace

template <int dim>
RepeatedCells<dim>::RepeatedCells(const mesh::BlockMesh<dim>& mesh, const Table<BlockId, Tensor<dim>>& conductivity,
                                  SpaceOrder order)
    : which_(mesh.cells.size(), -1) {
  ShapeList<dim> list;
  for (const BlockId block : mesh.blocks.ids()) {
    for (const CellId cell : mesh.blocks[block].cells) {
      which_[cell] = list.number(Shape<dim>(mesh.cells[cell], cell_points(mesh, mesh.cells[cell]), conductivity[block]));
    }
  }
  std::vector<std::int32_t> place(list.shapes().size(), -1);  // in shapes_, of those that repeat
  for (const auto& [shape, entry] : list.shapes()) {
    if (entry.cells < 2) continue;
    place[static_cast<std::size_t>(entry.number)] = static_cast<std::int32_t>(shapes_.size());
    shapes_.push_back(corners_of<dim>(shape, order));
  }
  for (std::int32_t& which : which_) which = which < 0 ? -1 : place[static_cast<std::size_t>(which)];
}

template class RepeatedCells<2>;
template class RepeatedCells<3>;

}  // namespace scree::thermal
