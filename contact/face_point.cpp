#include "contact/face_point.h"

#include <limits>

#include "contact/segment.h"

namespace scree::contact {

template <>
std::array<double, 2> closest_weights<2>(const Corners<2>& corners, const Point<2>& point) {
  const double along = closest_on_segment<2>(corners[0], corners[1], point);
  return {1 - along, along};
}

template <>
std::array<double, 3> closest_weights<3>(const Corners<3>& corners, const Point<3>& point) {
  // Barycentric coordinates of the projection: ratios of the areas of the triangles it forms with the three edges.
  const Point<3> normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double square = normal.squaredNorm();
  std::array<double, 3> weights{};
  for (int i = 0; i < 3; ++i) {
    const Point<3>& next = corners[(i + 1) % 3];
    weights[i] = (corners[(i + 2) % 3] - next).cross(point - next).dot(normal) / square;
  }
  if (weights[0] > 0 && weights[1] > 0 && weights[2] > 0) return weights;

  // Outside: on the rim, and there only an edge beyond which the projection lies can be closest.
  std::array<double, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (weights[i] > 0) continue;
    const int from = (i + 1) % 3, to = (i + 2) % 3;
    const double along = closest_on_segment<3>(corners[from], corners[to], point);
    const Point<3> at = (1 - along) * corners[from] + along * corners[to];
    const double distance_sq = (at - point).squaredNorm();
    if (distance_sq >= least) continue;
    least = distance_sq;
    best = {};
    best[from] = 1 - along;
    best[to] = along;
  }
  return best;
}

}  // namespace scree::contact
