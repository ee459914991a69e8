// Long edges of a closed surface cut in halves.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace scree::mesh {

struct ClosedSurface {
  std::vector<Eigen::Vector3d> points;                // [m]
  std::vector<std::array<std::size_t, 3>> triangles;  // two at every edge
};

// Halves the longest edge, and the two triangles at it, until none is longer than `longest` [m]. The shape stays the same to
// rounding, and since it is always the longest edge, the angles do not degenerate (Rivara 1984).
ClosedSurface refined(ClosedSurface surface, double longest);

}  // namespace scree::mesh
