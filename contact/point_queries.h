// Semi-springs and target faces that are measured together, four or eight at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "contact/point_touch.h"

namespace scree::contact {

template <int dim>
class PointQueries {
 public:
  static constexpr std::size_t most = 64;

  void clear() { count_ = 0; }
  [[nodiscard]] std::size_t count() const { return count_; }

  // No more than `most`.
  SCREE_INLINE void add(const PointQuery<dim, double>& query) {
    auto* number = asked_.data();
    const auto put = [&](double value) { (*number++)[count_] = value; };
    for_each_number(query, put);
    ++count_;
  }

  // Measures them all, see point_touch.h.
  void measure(double tolerance, double rounding);

  // The semi-spring of a query.
  [[nodiscard]] Point<dim> point(std::size_t i) const {
    Point<dim> point;
    for (int axis = 0; axis < dim; ++axis) point[axis] = asked_[axis][i];
    return point;
  }
  [[nodiscard]] PointAnswer<dim, double> answer(std::size_t i) const {
    PointAnswer<dim, double> answer{};
    for (int corner = 0; corner < dim; ++corner) answer.on_target[corner] = on_target_[corner][i];
    for (int axis = 0; axis < dim; ++axis) answer.offset[axis] = offset_[axis][i];
    answer.gap = gap_[i];
    answer.facing = facing_[i];
    answer.near = static_cast<int>(near_ >> i & 1u);
    answer.on_rim = static_cast<int>(on_rim_ >> i & 1u);
    answer.apart = static_cast<int>(apart_ >> i & 1u);
    return answer;
  }

 private:
  template <class Query, class Visit>
  static SCREE_INLINE void for_each_number(Query& query, const Visit& visit) {
    for (int i = 0; i < dim; ++i) visit(query.point[i]);
    for (int i = 0; i < dim; ++i) visit(query.vertex[i]);
    for (int i = 0; i < dim; ++i) visit(query.owner_normal[i]);
    visit(query.length);
    for (auto& corner : query.corners) {
      for (int i = 0; i < dim; ++i) visit(corner[i]);
    }
    for (int i = 0; i < dim; ++i) visit(query.target_normal[i]);
  }

  using Numbers = std::array<double, most>;  // one of each query
  static constexpr std::size_t numbers = dim * dim + 4 * dim + 1;

  std::size_t count_ = 0;
  alignas(sizeof(Octet)) std::array<Numbers, numbers> asked_;
  alignas(sizeof(Octet)) std::array<Numbers, dim> on_target_, offset_;
  alignas(sizeof(Octet)) Numbers gap_, facing_;
  std::uint64_t near_, on_rim_, apart_;  // a bit of each
};

}  // namespace scree::contact
