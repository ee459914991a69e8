#include "engine/output/camera.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace scree::output {
namespace {

// Where a point appears, with the picture's edges at -1 and 1.
Eigen::Vector2d seen(const Camera& camera, const Lens& lens, const Eigen::Vector3d& point) {
  const Eigen::Vector3d forward = (camera.focus - camera.eye).normalized();
  const Eigen::Vector3d right = forward.cross(camera.up);
  const Eigen::Vector3d ray = point - camera.eye;
  const double tangent = std::tan(lens.angle / 2 * std::numbers::pi / 180);
  return Eigen::Vector2d(ray.dot(right) / lens.aspect, ray.dot(camera.up)) / (ray.dot(forward) * tangent);
}

TEST(Camera, ShowsAllPointsInTheMiddleAndFillsThePicture) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const double aspect : {0.5, 1.0, 1.5}) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 30; ++i) points.emplace_back(coordinate(random), 2 + coordinate(random), 0.3 * coordinate(random));
    const Lens lens{.aspect = aspect};
    const Camera camera = aim(points, {0.4, -1, 0.5}, Eigen::Vector3d::UnitZ(), lens);
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3d& point : points) box.extend(seen(camera, lens, point));
    EXPECT_LE(box.max().maxCoeff(), 1);
    EXPECT_GE(box.min().minCoeff(), -1);
    EXPECT_GT(box.sizes().maxCoeff(), 1.8);
    EXPECT_NEAR(box.center().norm(), 0, 0.005);
    EXPECT_NEAR(camera.up.norm(), 1, 1e-12);
    EXPECT_GT(camera.up.z(), 0);
  }
}

}  // namespace
}  // namespace scree::output
