// When a pile counts as at rest.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/rigid/settle.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using testing::add_box;

// Thrown up so that a window later it is where it was, at a speed that is lost in the mean beside a block of 2.5 t.
TEST(Rest, AStoneThatIsBackWhereItWasAfterAWindowHasMoved) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
  add_box(mesh, {1, 1, 1}, {0, 0, 0.5}, false);
  SettleOptions options;
  const double speed = testing::g * (options.rest_window + options.step) / 2;
  const BlockId stone = add_box(mesh, {0.003, 0.003, 0.003}, {1, 0, 1}, false, {0, 0, speed});
  options.limit = options.rest_window;
  const packing::Packing<3> packing = settle(mesh, testing::material(0.6), options);
  const packing::SettleReport& report = *packing.settled;
  EXPECT_LT(packing.poses[stone].translation.norm(), 1e-9);
  EXPECT_LT(report.rms_speed, options.rest_speed);
  EXPECT_FALSE(report.at_rest);
  EXPECT_NEAR(report.max_displacement, testing::g * options.rest_window * options.rest_window / 8, 1e-9);
  EXPECT_NE(report.criterion.find("a point of block 2 moved"), std::string::npos) << report.criterion;
}

// 1.25 mm in a window: little for a boulder, and nothing in the mean over masses.
TEST(Rest, APebbleThatSlidesOnBesideABoulderHasMovedByItsOwnMeasure) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
  add_box(mesh, {1, 1, 1}, {0, 0, 0.5}, false);
  add_box(mesh, {0.003, 0.003, 0.003}, {1, 0, 0.0015}, false, {0, 0.005, 0});
  SettleOptions options;
  options.limit = 1;
  const packing::Packing<3> packing = settle(mesh, testing::material(0), options);
  const packing::SettleReport& report = *packing.settled;
  EXPECT_LT(report.rms_speed, options.rest_speed);
  EXPECT_NEAR(report.max_displacement, 0.005 * report.window, 1e-5);
  EXPECT_FALSE(report.at_rest);
  EXPECT_NE(report.criterion.find("a point of block 2 moved"), std::string::npos) << report.criterion;
}

// Corners are rounded there by 1e-9 m, and edges that are parallel cross at a small angle.
TEST(Rest, OfCubesThatStandFlushIsTheSameAtSurveyCoordinates) {
  mesh::BlockMesh<3> mesh;
  const testing::Vector3d site(500000, 6000000, 300);
  add_box(mesh, {2, 2, 0.1}, site - testing::Vector3d(0, 0, 0.05), true);
  for (int i = 0; i < 48; ++i) {
    add_box(mesh, {0.1, 0.1, 0.1}, site + 0.1 * testing::Vector3d(i % 4, i / 4 % 4, i / 16 + 0.5), false);
  }
  SettleOptions options;
  options.limit = 1;
  const packing::Packing<3> packing = settle(mesh, testing::material(0.6), options);
  EXPECT_TRUE(packing.settled->at_rest) << packing.settled->criterion;
  EXPECT_LT(packing.settled->deepest_overlap, 1e-3);
}

TEST(Rest, OfWhatDragHasNotActedOnYetIsNotSaidToBeFast) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
  add_box(mesh, {1, 1, 1}, {0, 0, 0.5}, false);
  SettleOptions options;
  options.viscous_damping = 0.1;
  options.limit = 1;
  const packing::Packing<3> packing = settle(mesh, testing::material(0.6), options);
  EXPECT_FALSE(packing.settled->at_rest);
  EXPECT_NE(packing.settled->criterion.find("the drag was still on, for it takes 10 s to act"), std::string::npos)
      << packing.settled->criterion;
}

// Where gravity is weak a fall begins so slowly that it is rest by the mean speed and force.
TEST(Rest, ABlockThatFallsAtATenthOfAPercentOfGravityIsNotAtRest) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
  for (int i = 0; i < 36; ++i) add_box(mesh, {0.1, 0.1, 0.1}, {0.3 * (i % 6) - 1, 0.3 * (i / 6) - 1, 0.05}, false);
  const BlockId last = add_box(mesh, {0.1, 0.1, 0.1}, {1.5, 0, 3}, false);
  SettleOptions options;
  options.gravity = {0, 0, -0.01};
  options.limit = 60;
  const packing::Packing<3> packing = settle(mesh, testing::material(0.6), options);
  EXPECT_TRUE(packing.settled->at_rest) << packing.settled->criterion;
  EXPECT_GT(packing.settled->simulated_time, std::sqrt(2 * 2.95 / 0.01));
  EXPECT_NEAR(packing.poses[last].translation.z(), -2.95, 1e-3);
}

// In weak gravity nothing gets far in a window that is long enough on the earth.
TEST(Rest, ABlockThatSlidesOnAtATenthOfAPercentOfGravityIsNotAtRest) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
  for (int i = 0; i < 25; ++i) add_box(mesh, {0.05, 0.05, 0.05}, {0.1 * (i % 5) - 1.2, 0.1 * (i / 5), 0.025}, false);
  add_box(mesh, {0.05, 0.05, 0.05}, {1, 0, 0.025}, false);
  mesh.bodies[BodyId{mesh.bodies.size() - 1}].material = MaterialId{1};
  SettleOptions options;
  options.gravity = {0.002, 0, -0.01};
  options.limit = 5;
  Table<MaterialId, Material> materials = testing::material(0.6);
  materials.push_back(testing::material(0)[MaterialId{0}]);
  const packing::Packing<3> packing = settle(mesh, materials, options);
  EXPECT_FALSE(packing.settled->at_rest) << packing.settled->criterion;
}

}  // namespace
}  // namespace scree::rigid
