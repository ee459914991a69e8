// The faces of a surface as the grid sees them, and the cheap bounds that dismiss most pairs it finds.
#pragma once

#include <algorithm>
#include <array>

#include "contact/face_grid.h"
#include "contact/surface.h"

namespace scree::contact {

// Each face looks as far as `tolerance` times its characteristic length.
template <int dim>
Table<FaceId, FaceBounds<dim>> face_bounds(const Surface<dim>& surface, double tolerance);

// Heights of a face's corners above the plane of another.
template <int dim>
std::array<double, dim> heights_above(const FaceBounds<dim>& plane, const Corners<dim>& corners) {
  std::array<double, dim> heights;
  for (int i = 0; i < dim; ++i) heights[i] = plane.normal.dot(corners[i]) - plane.offset;
  return heights;
}

template <std::size_t count>
bool all_beyond(const std::array<double, count>& heights, double reach) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return *low > reach || *high < -reach;
}

}  // namespace scree::contact
