// Closest point on a face: a segment in 2-D, a triangle in 3-D.
#pragma once

#include <array>

#include "engine/base/geometry.h"

namespace scree::contact {

template <int dim>
using Corners = std::array<Point<dim>, dim>;

// Weights of the corners, each in [0, 1], summing to 1. A corner has the weight 0 exactly if the closest point lies on the
// part of the rim opposite to it, so that the zeros name the vertex or edge.
template <int dim>
std::array<double, dim> closest_weights(const Corners<dim>& corners, const Point<dim>& point);

template <int dim>
Point<dim> weighted_point(const Corners<dim>& corners, const std::array<double, dim>& weights) {
  Point<dim> sum = weights[0] * corners[0];
  for (int i = 1; i < dim; ++i) sum += weights[i] * corners[i];
  return sum;
}

}  // namespace scree::contact
