#include "engine/packing/bulk.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::packing {
namespace {

using Eigen::Vector3d;
using rigid::testing::add_box;
using rigid::testing::add_tetrahedron;

// n^3 cubes with gaps between them on a floor, their spacing 1 m, in a box of walls if asked for.
mesh::BlockMesh<3> lattice(int n, double edge, bool walls) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4.0 * n, 4.0 * n, 1}, Vector3d(0, 0, -0.5), true);
  for (int i = 0; i < n * n * n; ++i) {
    const Vector3d at = Vector3d(i % n, i / n % n, i / n / n) + Vector3d(0.5 - n / 2.0, 0.5 - n / 2.0, 0.5);
    add_box(mesh, Vector3d::Constant(edge), at, false);
  }
  if (walls) {
    for (const double side : {-1.0, 1.0}) {
      add_box(mesh, {1, 4.0 * n, 3.0 * n}, Vector3d(side * (n + 1) / 2, 0, 1.5 * n), true);
      add_box(mesh, {4.0 * n, 1, 3.0 * n}, Vector3d(0, side * (n + 1) / 2, 1.5 * n), true);
    }
  }
  // Turned, so that the lines do not fall into step with the lattice.
  const Eigen::AngleAxisd turn(0.3, Vector3d::UnitZ());
  for (Point<3>& node : mesh.nodes) node = turn * node;
  return mesh;
}

Columns cut(const mesh::BlockMesh<3>& mesh, const std::vector<BlockId>& left_out = {}) {
  const PieceSet pieces(mesh);
  return cut_by_lines(mesh, pieces, left_out);
}

TEST(InnerPorosity, OfALatticeIsThatOfItsCellOverTheStatedHeights) {
  for (const bool walls : {false, true}) {
    const auto inner = inner_porosity(cut(lattice(10, 0.9, walls)));
    ASSERT_TRUE(inner);
    EXPECT_NEAR(inner->box.min().z(), 0.9, 1e-9);
    EXPECT_NEAR(inner->box.max().z(), 9.95 - 0.9, 1e-9);
    // Of these 8.15 m, eight cubes take 0.9 each and a ninth its uppermost 0.05; across, the cubes fill 0.81.
    EXPECT_NEAR(inner->porosity, 1 - 0.81 * 7.25 / 8.15, 0.01) << walls;
    const double across = 2 * 4.95 - 2 * 0.9;
    EXPECT_NEAR(inner->volume / 8.15, across * across, 0.1 * across * across) << walls;
  }
}

TEST(InnerPorosity, OfSolidCubesIsZeroAndOverlapsCountOnce) {
  EXPECT_NEAR(inner_porosity(cut(lattice(6, 1, false)))->porosity, 0, 1e-12);
  EXPECT_NEAR(inner_porosity(cut(lattice(6, 1.1, false)))->porosity, 0, 1e-12);
}

TEST(InnerPorosity, OfAFewBlocksIsNotKnown) {
  EXPECT_FALSE(inner_porosity(cut(lattice(1, 1, false))));
  EXPECT_FALSE(inner_porosity(Columns{}));
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
  mesh::BlockMesh<3> mesh = lattice(1, 1, false);
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

TEST(AngleOfRepose, IsNotGivenForAPileThatWallsHoldNorForOneBlock) {
  EXPECT_FALSE(angle_of_repose(cut(lattice(8, 0.9, true))));
  EXPECT_FALSE(angle_of_repose(cut(lattice(1, 1, false))));
}

}  // namespace
}  // namespace scree::packing
