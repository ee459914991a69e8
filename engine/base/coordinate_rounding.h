// What coordinates may be off by far from the origin, as of a site in metres of a national grid.
#pragma once

#include <limits>

#include "engine/base/geometry.h"

namespace scree {

// The difference of two coordinates of points in a box, each a sum of a few numbers, may be off by this [m].
template <int dim>
double coordinate_rounding(const Aabb<dim>& box) {
  constexpr double roundings = 8;
  if (box.isEmpty()) return 0;
  const double furthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return roundings * std::numeric_limits<double>::epsilon() * furthest;
}

}  // namespace scree
