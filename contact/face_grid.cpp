#include "contact/face_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace scree::contact {

namespace {

// Cell edge in sizes of a level's middle face. Smaller cells cost more entries per face, larger ones more candidates; on piles
// of tetrahedra the time is flat between 0.5 and 1.1, and 0.3 costs a fifth more (three times more for sizes of 1:100).
constexpr double cell_per_size = 0.8;

// Odd multipliers that send neighbouring rows of cells to unrelated slots; within a row slots follow one another.
constexpr std::array<std::uint64_t, 3> row_stride = {1, 0x9E3779B97F4A7C15ull, 0xC2B2AE3D27D4EB4Full};

template <int dim>
double size_of(const FaceBounds<dim>& face) {
  return face.box.sizes().maxCoeff();
}

}  // namespace

template <int dim>
FaceGrid<dim>::FaceGrid(const Table<FaceId, FaceBounds<dim>>& faces) : faces_(faces) {
  if (faces_.empty()) return;
  Aabb<dim> all;
  for (const auto& face : faces_) all.extend(face.box);
  origin_ = all.min();
  assign_orders();

  const auto [low, high] = std::minmax_element(orders_.begin(), orders_.end());
  for (int order = *low; order <= *high; ++order) {
    std::vector<std::int32_t> members;
    for (std::size_t f = 0; f < orders_.size(); ++f) {
      if (orders_[f] == order) members.push_back(static_cast<std::int32_t>(f));
    }
    if (members.empty()) continue;
    Level level;
    level.order = order;
    level.cells_per_metre = 1 / (cell_per_size * median_size_ * std::pow(4.0, order));
    fill(level, members);
    levels_.push_back(std::move(level));
  }
}

template <int dim>
void FaceGrid<dim>::assign_orders() {
  std::vector<double> sizes;
  sizes.reserve(faces_.size());
  for (const auto& face : faces_) sizes.push_back(size_of(face));
  std::vector<double> sorted = sizes;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  median_size_ = sorted[sorted.size() / 2];
  orders_.reserve(sizes.size());
  for (const double size : sizes) {
    // The middle of level 0 is a factor two either way, so that one mesh size falls into one level.
    orders_.push_back(static_cast<std::int8_t>(std::lround(0.5 * std::log2(size / median_size_))));
  }
}

template <int dim>
void FaceGrid<dim>::fill(Level& level, const std::vector<std::int32_t>& members) const {
  level.mask = std::bit_ceil(members.size() * 8) - 1;
  level.starts.assign(level.mask + 2, 0);
  for (const auto f : members) {
    visit_slots(faces_.raw()[f], level, [&](std::uint64_t slot) { ++level.starts[slot + 1]; });
  }
  for (std::size_t slot = 1; slot < level.starts.size(); ++slot) level.starts[slot] += level.starts[slot - 1];
  level.entries.resize(level.starts.back());
  std::vector<std::uint32_t> next(level.starts.begin(), level.starts.end() - 1);
  for (const auto f : members) {
    visit_slots(faces_.raw()[f], level, [&](std::uint64_t slot) { level.entries[next[slot]++] = f; });
  }
}

template <int dim>
template <class Visit>
void FaceGrid<dim>::visit_slots(const FaceBounds<dim>& face, const Level& level, const Visit& visit) const {
  using Cell = Eigen::Matrix<std::int64_t, dim, 1>;
  const Point<dim> from = (face.box.min() - origin_) * level.cells_per_metre;
  const Point<dim> to = (face.box.max() - origin_) * level.cells_per_metre;
  const Cell low = from.array().floor().matrix().template cast<std::int64_t>();
  const Cell high = to.array().floor().matrix().template cast<std::int64_t>();
  // In units of cells: signed height of a cell's centre above the plane, and how much of it is still a crossing.
  const double offset = (face.offset - face.normal.dot(origin_)) * level.cells_per_metre;
  const double thickness = face.reach * level.cells_per_metre + 0.5 * face.normal.template lpNorm<1>() + 1e-9;
  Cell cell = low;
  for (int axis = 0; axis < dim;) {
    const Point<dim> centre = cell.template cast<double>().array() + 0.5;
    if (std::abs(face.normal.dot(centre) - offset) <= thickness) {
      std::uint64_t slot = 0;
      for (int i = 0; i < dim; ++i) slot += static_cast<std::uint64_t>(cell[i]) * row_stride[i];
      visit(slot & level.mask);
    }
    for (axis = 0; axis < dim && ++cell[axis] > high[axis]; ++axis) cell[axis] = low[axis];
  }
}

template <int dim>
typename FaceGrid<dim>::Scratch FaceGrid<dim>::make_scratch() const {
  return {std::vector<std::int32_t>(faces_.size(), -1), {}};
}

template <int dim>
void FaceGrid<dim>::find(FaceId face, Scratch& scratch) const {
  scratch.found.clear();
  const FaceBounds<dim>& own = faces_[face];
  const int own_order = orders_[face.index()];
  for (const Level& level : levels_) {
    if (level.order < own_order) continue;
    const bool own_level = level.order == own_order;
    visit_slots(own, level, [&](std::uint64_t slot) {
      for (std::uint32_t i = level.starts[slot]; i < level.starts[slot + 1]; ++i) {
        const std::int32_t other = level.entries[i];
        if (own_level && other >= face.value()) break;  // entries of a slot ascend
        if (scratch.seen_by[other] == face.value()) continue;
        scratch.seen_by[other] = face.value();
        const FaceBounds<dim>& bounds = faces_.raw()[other];
        if (bounds.block == own.block || !bounds.box.intersects(own.box)) continue;
        scratch.found.push_back(FaceId{static_cast<std::size_t>(other)});
      }
    });
  }
}

template class FaceGrid<2>;
template class FaceGrid<3>;

}  // namespace scree::contact
