#include "engine/mesh/surface_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace scree::mesh {
namespace {

using Eigen::Vector3d;

// A plate with a line of points along two of its edges, as a program writes it that cuts faces like fans: its sides are
// needles.
ClosedSurface plate_of_needles(double length, double width, double height, std::size_t points_along) {
  std::vector<Eigen::Vector2d> outline{{0, 0}, {length, 0}};
  for (std::size_t i = 0; i <= points_along; ++i)
    outline.emplace_back(length * (1 - static_cast<double>(i) / static_cast<double>(points_along)), height);
  const std::size_t n = outline.size();
  ClosedSurface plate;
  for (const double y : {0.0, width}) {
    for (const auto& point : outline) plate.points.emplace_back(point.x(), y, point.y());
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    plate.triangles.push_back({0, i, i + 1});
    plate.triangles.push_back({n, n + i + 1, n + i});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    plate.triangles.push_back({i, n + i, next});
    plate.triangles.push_back({next, n + i, n + next});
  }
  return plate;
}

struct Measures {
  double area = 0, volume = 0, longest = 0, least_angle = M_PI;
};

Measures measures(const ClosedSurface& surface) {
  Measures m;
  for (const auto& triangle : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d& a = surface.points[triangle[i]];
      const Vector3d u = surface.points[triangle[(i + 1) % 3]] - a, v = surface.points[triangle[(i + 2) % 3]] - a;
      m.longest = std::max(m.longest, u.norm());
      m.least_angle = std::min(m.least_angle, std::atan2(u.cross(v).norm(), u.dot(v)));
      if (i == 0) m.area += u.cross(v).norm() / 2;
      if (i == 0) m.volume += a.dot(u.cross(v)) / 6;
    }
  }
  return m;
}

TEST(SurfaceRefinement, HalvesLongEdgesAndKeepsTheShapeToRounding) {
  const double length = 2, width = 0.6, height = 0.1;
  const Measures refined_plate = measures(refined(plate_of_needles(length, width, height, 40), 0.07));
  EXPECT_LE(refined_plate.longest, 0.07);
  EXPECT_NEAR(refined_plate.area, 2 * (length * width + length * height + width * height), 1e-12);
  EXPECT_NEAR(std::abs(refined_plate.volume), length * width * height, 1e-12);
}

TEST(SurfaceRefinement, CutsFlatPartsSoThatNoNeedlesAreLeft) {
  const ClosedSurface plate = plate_of_needles(2, 0.6, 0.1, 40);
  EXPECT_LT(measures(plate).least_angle, 0.002);
  const ClosedSurface fine = refined(plate, 0.07);
  EXPECT_GT(measures(fine).least_angle, 15 * M_PI / 180);
  // Of regular triangles with such sides there would be 1,400.
  EXPECT_LT(fine.triangles.size(), 4000u);
}

TEST(SurfaceRefinement, LeavesTwoTrianglesAtEveryEdge) {
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const auto& triangle : refined(plate_of_needles(2, 0.6, 0.1, 40), 0.07).triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++uses[{triangle[i], triangle[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(uses.count({edge.second, edge.first}), 1u);  // the one on the other side runs the other way
  }
}

TEST(SurfaceRefinement, KeepsTheEdgesOfAShape) {
  // A roof whose ridge bends it by a hundredth: the ridge's other diagonal would be nearer to Delaunay's rule.
  const double rise = 0.01;
  ClosedSurface roof;
  roof.points = {{-1, 0, rise}, {1, 0, rise}, {0, 0.1, 0}, {0, -0.1, 0}, {0, 0, -1}};
  roof.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}};
  const Measures before = measures(roof), after = measures(refined(roof, 0.5));
  EXPECT_NEAR(after.volume, before.volume, 1e-14);
  EXPECT_NEAR(after.area, before.area, 1e-14);
}

}  // namespace
}  // namespace scree::mesh
