#include "engine/output/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace scree::output {

Camera aim(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& back, const Eigen::Vector3d& vertical,
           const Lens& lens) {
  Eigen::Matrix3d axes;  // rows: right, up, back
  axes.row(2) = back.normalized();
  axes.row(0) = vertical.cross(back).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  const double tangent = std::tan(lens.angle / 2 * std::numbers::pi / 180);

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  Eigen::Vector3d focus = box.center();
  const auto nearest_distance = [&] {
    double distance = 0;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d local = axes * (point - focus);
      distance = std::max(distance, local.z() + std::max(std::abs(local.x()) / lens.aspect, std::abs(local.y())) / tangent);
    }
    return std::max(distance, 1e-6);  // a single point
  };
  double distance = nearest_distance();
  // What is in the middle depends on the distance, and the reverse; a few rounds settle both to a pixel.
  for (int round = 0; round < 4; ++round) {
    Eigen::AlignedBox2d seen;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d local = axes * (point - focus);
      seen.extend((local.head<2>() / (lens.margin * distance - local.z())).eval());
    }
    focus += distance * axes.topRows<2>().transpose() * seen.center();
    distance = nearest_distance();
  }
  return {focus + lens.margin * distance * axes.row(2).transpose(), focus, axes.row(1)};
}

}  // namespace scree::output
