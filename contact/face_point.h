// Closest point on a face: a segment in 2-D, a triangle in 3-D.
#pragma once

#include <array>
#include <limits>

#include "contact/coordinates.h"

namespace scree::contact {

template <int dim>
using Corners = std::array<Point<dim>, dim>;

template <int dim, class Number>
using CornerCoordinates = std::array<Coordinates<dim, Number>, dim>;

template <int dim, class Number>
SCREE_INLINE Coordinates<dim, Number> weighted_point(const CornerCoordinates<dim, Number>& corners,
                                                     const std::array<Number, dim>& weights) {
  Coordinates<dim, Number> sum;
  for (int i = 0; i < dim; ++i) {
    sum[i] = weights[0] * corners[0][i];
    for (int corner = 1; corner < dim; ++corner) sum[i] += weights[corner] * corners[corner][i];
  }
  return sum;
}

template <int dim>
Point<dim> weighted_point(const Corners<dim>& corners, const std::array<double, dim>& weights) {
  Point<dim> sum = weights[0] * corners[0];
  for (int i = 1; i < dim; ++i) sum += weights[i] * corners[i];
  return sum;
}

// Where on the segment from `start` to `end` the closest point to `point` is, as a fraction of the way in [0, 1].
template <int dim, class Number>
SCREE_INLINE Number closest_on_segment(const Coordinates<dim, Number>& start, const Coordinates<dim, Number>& end,
                                       const Coordinates<dim, Number>& point) {
  const auto way = minus<dim>(end, start);
  const Number along = dot<dim>(way, minus<dim>(point, start)) / dot<dim>(way, way);
  const Number zero{}, one = zero + 1;
  return chosen(below(along, zero), zero, chosen(below(one, along), one, along));
}

template <int dim, class Number>
struct ClosestPoint {
  std::array<Number, dim> weights;  // of the corners, each in [0, 1], summing to 1
  MaskOf<Number> on_rim;            // whether one of them is 0
};

// A corner has the weight 0 exactly if the closest point lies on the part of the rim opposite to it, so that the zeros name the
// vertex or edge.
template <int dim, class Number>
SCREE_INLINE ClosestPoint<dim, Number> closest_point(const CornerCoordinates<dim, Number>& corners,
                                                     const Coordinates<dim, Number>& point) {
  const Number zero{};
  if constexpr (dim == 2) {
    const Number along = closest_on_segment<2>(corners[0], corners[1], point);
    const MaskOf<Number> on_end = at_most(along, zero) | at_most(1 - along, zero);
    return {{1 - along, along}, on_end};
  } else {
    // Barycentric coordinates of the projection: ratios of the areas of the triangles it forms with the three edges.
    const auto normal = cross(minus<3>(corners[1], corners[0]), minus<3>(corners[2], corners[0]));
    const Number square = dot<3>(normal, normal);
    std::array<Number, 3> weights;
    for (int i = 0; i < 3; ++i) {
      const auto& next = corners[(i + 1) % 3];
      weights[i] = dot<3>(cross(minus<3>(corners[(i + 2) % 3], next), minus<3>(point, next)), normal) / square;
    }
    // Outside: on the rim, and there only an edge beyond which the projection lies can be closest.
    std::array<Number, 3> best{};
    Number least = zero + std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const int from = (i + 1) % 3, to = (i + 2) % 3;
      const Number along = closest_on_segment<3>(corners[from], corners[to], point);
      Coordinates<3, Number> off;
      for (int axis = 0; axis < 3; ++axis) {
        off[axis] = ((1 - along) * corners[from][axis] + along * corners[to][axis]) - point[axis];
      }
      const Number distance = dot<3>(off, off);
      const auto closer = at_most(weights[i], zero) & below(distance, least);
      least = chosen(closer, distance, least);
      best[i] = chosen(closer, zero, best[i]);
      best[from] = chosen(closer, 1 - along, best[from]);
      best[to] = chosen(closer, along, best[to]);
    }
    const auto inside = below(zero, weights[0]) & below(zero, weights[1]) & below(zero, weights[2]);
    for (int i = 0; i < 3; ++i) weights[i] = chosen(inside, weights[i], best[i]);
    const MaskOf<Number> on_rim = at_most(weights[0], zero) | at_most(weights[1], zero) | at_most(weights[2], zero);
    return {weights, on_rim};
  }
}

template <int dim>
std::array<double, dim> closest_weights(const Corners<dim>& corners, const Point<dim>& point) {
  CornerCoordinates<dim, double> of_corners;
  for (int i = 0; i < dim; ++i) of_corners[i] = coordinates<dim>(corners[i]);
  return closest_point<dim, double>(of_corners, coordinates<dim>(point)).weights;
}

}  // namespace scree::contact
