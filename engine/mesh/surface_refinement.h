// Long edges of a closed surface cut in halves, and its flat parts cut into better triangles.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace scree::mesh {

struct ClosedSurface {
  std::vector<Eigen::Vector3d> points;                // [m]
  std::vector<std::array<std::size_t, 3>> triangles;  // two at every edge
};

// Whether a triangle has no area beside the square of its longest edge.
bool is_flat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// Halves the longest edge, and the two triangles at it, until none is longer than `longest` [m]. The shape stays the same to
// rounding. Since it is always the longest edge, the angles do not degenerate (Rivara 1984); where two triangles lie in one
// plane their common edge is turned by Delaunay's rule (Lawson 1977), so that needles, as programs write them that cut large
// faces like fans, go.
ClosedSurface refined(ClosedSurface surface, double longest);

}  // namespace scree::mesh
