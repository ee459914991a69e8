// Closest points of straight lines.
#pragma once

#include <cmath>
#include <optional>

#include "engine/base/geometry.h"

namespace scree::contact {

// Two edges closer to parallel than this have no crossing to speak of: its place along them would be the tolerance
// divided by this sine. What touches along parallel edges is found by semi-springs.
inline constexpr double least_crossing_sine = 0.0175;  // of 1 degree

// The closest approach of the lines through a0, a1 and b0, b1.
struct Crossing {
  double along_a = 0;      // fraction of the way from a0 to a1; outside [0, 1] beyond the ends
  double along_b = 0;      // the same on b
  Eigen::Vector3d normal;  // unit, perpendicular to both
};

// Nothing for (nearly) parallel lines.
inline std::optional<Crossing> line_crossing(const Point<3>& a0, const Point<3>& a1, const Point<3>& b0, const Point<3>& b1) {
  const Point<3> a = a1 - a0, b = b1 - b0, between = b0 - a0;
  const Point<3> normal = a.cross(b);
  const double square = normal.squaredNorm();
  if (square < least_crossing_sine * least_crossing_sine * a.squaredNorm() * b.squaredNorm()) return std::nullopt;
  return Crossing{between.cross(b).dot(normal) / square, between.cross(a).dot(normal) / square, normal / std::sqrt(square)};
}

}  // namespace scree::contact
