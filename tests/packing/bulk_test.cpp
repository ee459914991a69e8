#include "engine/packing/bulk.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::packing {
namespace {

using Eigen::Vector3d;
using rigid::testing::add_box;
using rigid::testing::add_tetrahedron;

// Cubes with gaps between them on a floor, their spacing 1 m, n each way and `layers` of them, in a box of walls if asked for;
// turned about the vertical.
mesh::BlockMesh<3> lattice(int n, int layers, double edge, bool walls, double angle = 0.3) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4.0 * n, 4.0 * n, 1}, Vector3d(0, 0, -0.5), true);
  for (int i = 0; i < n * n * layers; ++i) {
    const Vector3d at = Vector3d(i % n, i / n % n, i / n / n) + Vector3d(0.5 - n / 2.0, 0.5 - n / 2.0, 0.5);
    add_box(mesh, Vector3d::Constant(edge), at, false);
  }
  if (walls) {
    for (const double side : {-1.0, 1.0}) {
      add_box(mesh, {1, 4.0 * n, 3.0 * n}, Vector3d(side * (n + 1) / 2, 0, 1.5 * n), true);
      add_box(mesh, {4.0 * n, 1, 3.0 * n}, Vector3d(0, side * (n + 1) / 2, 1.5 * n), true);
    }
  }
  const Eigen::AngleAxisd turn(angle, Vector3d::UnitZ());
  for (Point<3>& node : mesh.nodes) node = turn * node;
  return mesh;
}

// What cubes of that edge, one in the middle of each metre, fill of the metres from `low` to `high`.
double filled(double edge, double low, double high) {
  const auto until = [edge](double x) {
    const double begun = x - std::floor(x);
    return std::floor(x) * edge + std::clamp(begun - (1 - edge) / 2, 0.0, edge);
  };
  return (until(high) - until(low)) / (high - low);
}

Columns cut(const mesh::BlockMesh<3>& mesh, const std::vector<BlockId>& left_out = {}) {
  const PieceSet pieces(mesh);
  return cut_by_lines(mesh, pieces, left_out);
}

TEST(InnerPorosity, OfALatticeIsThatOfItsCubesInTheStatedRegionAsItsRowsRunAlongTheAxesOrNot) {
  constexpr int n = 24, layers = 6;
  for (const double edge : {0.75, 0.8, 0.9, 0.97}) {
    for (const double angle : {0.0, 0.3, M_PI / 4}) {
      const bool walls = edge == 0.9;
      const auto inner = inner_porosity(cut(lattice(n, layers, edge, walls, angle)));
      ASSERT_TRUE(inner);
      const double low = inner->box.min().z(), high = inner->box.max().z();
      EXPECT_NEAR(low, edge, 1e-9);
      EXPECT_NEAR(high, layers - (1 - edge) / 2 - edge, 1e-9);
      const double inside = n - (1 - edge) / 2 - edge;  // across: one cube's edge from the outermost cubes' sides
      const double across = filled(edge, n - inside, inside);
      EXPECT_NEAR(inner->porosity, 1 - across * across * filled(edge, low, high), 0.01) << edge << " " << angle;
      const double area = (2 * inside - n) * (2 * inside - n);
      EXPECT_NEAR(inner->volume / (high - low), area, 0.05 * area) << edge << " " << angle;
    }
  }
}

TEST(InnerPorosity, OfSolidCubesIsZeroAndOverlapsCountOnce) {
  EXPECT_NEAR(inner_porosity(cut(lattice(6, 6, 1, false)))->porosity, 0, 1e-12);
  EXPECT_NEAR(inner_porosity(cut(lattice(6, 6, 1.1, false)))->porosity, 0, 1e-12);
}

// Lines a quarter of a block apart that reach a stone so far away were too many, and wider ones see no neighbours.
TEST(InnerPorosity, OfAPileWithAStoneFarAwayIsNotKnown) {
  auto mesh = lattice(6, 6, 0.9, false);
  ASSERT_TRUE(inner_porosity(cut(mesh)));
  for (const NodeId node : mesh.blocks[BlockId{mesh.blocks.size() - 1}].nodes) mesh.nodes[node].x() += 3000;
  const Columns columns = cut(mesh);
  EXPECT_NEAR(columns.size, 0.9, 1e-9);
  EXPECT_TRUE(columns.lines.empty());
  EXPECT_FALSE(inner_porosity(columns));
}

TEST(InnerPorosity, OfAFewBlocksIsNotKnown) {
  EXPECT_FALSE(inner_porosity(cut(lattice(1, 1, 1, false))));
  EXPECT_FALSE(inner_porosity(Columns{}));
}

// A region that is smaller than a block may lie between two.
TEST(InnerPorosity, OfLessThanABlockIsNotKnown) {
  EXPECT_FALSE(inner_porosity(cut(lattice(3, 2, 0.9, false))));
  EXPECT_TRUE(inner_porosity(cut(lattice(6, 2, 0.9, false))));
}

TEST(Columns, ALineThroughATetrahedronIsInItAsLongAsItsThicknessThere) {
  mesh::BlockMesh<3> mesh;
  add_tetrahedron(mesh, {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)});
  for (const Column& column : cut(mesh).lines) {
    const double thickness = 1 - column.place.sum();
    if (column.place.minCoeff() < 0 || thickness <= 0) {
      EXPECT_TRUE(column.free.empty());
      continue;
    }
    ASSERT_EQ(column.free.size(), 1U);
    EXPECT_NEAR(column.free[0].high - column.free[0].low, thickness, 1e-12);
  }
}

TEST(Columns, ABlockThatIsLeftOutIsNotThere) {
  mesh::BlockMesh<3> mesh = lattice(1, 1, 1, false);
  const BlockId lost = add_box(mesh, Vector3d(1, 1, 1), Vector3d(30, 0, -20), false);
  EXPECT_LT(cut(mesh, {lost}).side * cut(mesh, {lost}).spacing, 6);
}

// A cone of cubes on a floor, whose steps follow a slope.
mesh::BlockMesh<3> cone(double slope) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {90, 90, 1}, Vector3d(0, 0, -0.5), true);
  constexpr int radius = 20;
  for (int i = -radius; i <= radius; ++i) {
    for (int j = -radius; j <= radius; ++j) {
      const double height = slope * (radius - std::hypot(i, j));
      for (int k = 0; k + 0.5 < height; ++k) add_box(mesh, Vector3d(1, 1, 1), Vector3d(i, j, k + 0.5), false);
    }
  }
  return mesh;
}

TEST(AngleOfRepose, OfAConeIsItsSlope) {
  for (const double degrees : {20.0, 35.0}) {
    const auto repose = angle_of_repose(cut(cone(std::tan(degrees * M_PI / 180))));
    ASSERT_TRUE(repose);
    EXPECT_NEAR(repose->angle * 180 / M_PI, degrees, 2);
  }
}

TEST(AngleOfRepose, OfAConeIsTheSameUnderAHopper) {
  mesh::BlockMesh<3> mesh = cone(0.7);
  const auto bare = angle_of_repose(cut(mesh));
  add_box(mesh, {5, 5, 3}, Vector3d(0, 0, 18), true);
  const auto under = angle_of_repose(cut(mesh));
  ASSERT_TRUE(bare && under);
  EXPECT_NEAR(under->angle, bare->angle, 1e-12);
}

// Cubes one above the other up to `height` at each place of a square of 51 by 51.
mesh::BlockMesh<3> heap(const std::function<double(double x, double y)>& height) {
  mesh::BlockMesh<3> mesh;
  for (int i = -25; i <= 25; ++i) {
    for (int j = -25; j <= 25; ++j) {
      for (int k = 0; k + 0.5 < height(i, j); ++k) add_box(mesh, Vector3d(1, 1, 1), Vector3d(i, j, k + 0.5), false);
    }
  }
  return mesh;
}

TEST(AngleOfRepose, IsNotGivenForWhatIsNoSingleRoundHeap) {
  const auto cone_at = [](double x, double y) { return 0.6 * (12 - std::hypot(x, y)); };
  EXPECT_TRUE(angle_of_repose(cut(heap(cone_at))));
  EXPECT_FALSE(angle_of_repose(cut(heap([&](double x, double y) { return std::max(cone_at(x - 9, y), cone_at(x + 9, y)); }))));
  EXPECT_FALSE(
      angle_of_repose(cut(heap([&](double x, double y) { return cone_at(std::max(0.0, std::abs(x) - 13), y); }))));  // a ridge
  EXPECT_FALSE(angle_of_repose(
      cut(heap([](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 16 ? 4.0 : 0.0; }))));  // a layer
}

TEST(AngleOfRepose, FitsARoundHeapNearlyAndAnOvalOneLess) {
  const auto fit = [](double aspect) {
    return angle_of_repose(cut(heap([&](double x, double y) { return 0.8 * (20 - std::hypot(aspect * x, y)); })))->fit;
  };
  EXPECT_GT(fit(1), 0.95);
  EXPECT_LT(fit(1.5), 0.85);
  EXPECT_GT(fit(1.5), 0.65);
}

TEST(AngleOfRepose, IsNotGivenForACrater) {
  mesh::BlockMesh<3> mesh;
  for (int i = 0; i < 21 * 21; ++i) {
    const Vector3d at(i % 21 - 10, i / 21 - 10, 0.5);
    for (int k = 0; k < 1 + static_cast<int>(at.head<2>().norm()) / 2; ++k)
      add_box(mesh, Vector3d(1, 1, 1), at + Vector3d(0, 0, k), false);
  }
  EXPECT_FALSE(angle_of_repose(cut(mesh)));
}

TEST(AngleOfRepose, IsNotGivenForAPileThatWallsHoldNorForOneBlock) {
  EXPECT_FALSE(angle_of_repose(cut(lattice(8, 8, 0.9, true))));
  EXPECT_FALSE(angle_of_repose(cut(lattice(1, 1, 1, false))));
}

}  // namespace
}  // namespace scree::packing
