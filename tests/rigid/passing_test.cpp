// Blocks that slide, fall and fly past each other.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;
using testing::add_box;
using testing::for_time;
using testing::g;
using testing::material;

// Tops level with each other: the side of the next plate is no obstacle, wherever in its step the block comes upon it.
TEST(Passing, ABlockSlidesOverTheSeamOfTwoPlatesAsOverOne) {
  for (const double friction : {0.0, 0.5}) {
    for (int phase = 0; phase < 10; ++phase) {
      mesh::BlockMesh<3> mesh;
      for (const double x : {-1.0, 1.0}) add_box(mesh, {2, 2, 0.1}, {x, 0, -0.05}, true);
      const double start = -0.2 - 0.00125 * phase;
      const BlockId block = add_box(mesh, {0.1, 0.1, 0.02}, {start, 0, 0.01}, false, {3, 0, 0});
      const Pose pose = settle(mesh, material(friction), for_time(0.25)).poses[block];
      const double way = 3 * 0.25 - 0.5 * friction * g * 0.25 * 0.25;
      EXPECT_NEAR(pose.translation.x(), way, friction > 0 ? 3.0 / 240 : 1e-7) << phase;
      EXPECT_LT(pose.translation.tail<2>().norm(), 1e-6);
      EXPECT_LT(pose.rotation.vec().norm(), 1e-5);
    }
  }
}

// A cube of 1 cm whose edge comes down across the edge of a plate; a boulder a hundred times as large, far away, is nothing to
// it.
TEST(Passing, APebbleMeetsAnEdgeTheSameWayWhateverElseThereIs) {
  const auto after = [](double time, bool boulder) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {1, 1, 1}, {-0.5, 0, -0.5}, true);
    // Its lowest edge falls off towards x, and lies over the plate's by a tenth of a millimetre.
    const Eigen::AngleAxisd about_x(M_PI / 4, Vector3d::UnitX()), about_y(M_PI / 4, Vector3d::UnitY());
    const Vector3d up(std::sqrt(0.5), 0, std::sqrt(0.5));
    const Pose pose{(0.005 * std::sqrt(2) + 1e-4) * up, Eigen::Quaterniond(about_y * about_x)};
    const BlockId pebble = add_box(mesh, Vector3d::Constant(0.01), pose, false);
    if (boulder) add_box(mesh, {1, 1, 1}, {20, 0, 0}, false);
    return settle(mesh, material(0.5), for_time(time)).poses[pebble].translation;
  };
  for (int steps = 1; steps <= 12; ++steps)
    EXPECT_LT((after(steps / 240.0, true) - after(steps / 240.0, false)).norm(), 0.05 * 0.01) << steps;
}

// Of blocks that are free themselves.
TEST(Passing, ABlockSlidesOverAPavementOfBlocks) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 1, 0.1}, {0, 0, -0.05}, true);
  for (int i = 0; i < 8; ++i) add_box(mesh, {0.25, 0.25, 0.25}, {-0.875 + 0.25 * i, 0, 0.125}, false);
  const BlockId block = add_box(mesh, {0.1, 0.1, 0.02}, {-0.6, 0, 0.26}, false, {1, 0, 0});
  EXPECT_NEAR(settle(mesh, material(0), for_time(1)).poses[block].translation.x(), 1, 1e-3);
}

// Level over the upper edge of a bar that stands on its edge, nearer than the way of a step, wherever in its step it comes
// there.
TEST(Passing, ABlockThatFliesPastAnEdgeWithoutTouchingItGoesOnAsItWas) {
  const Pose on_edge{{0, 0, -0.1 * std::sqrt(2)}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitY()))};
  for (const double restitution : {0.0, 0.8}) {
    for (int phase = 0; phase < 10; ++phase) {
      mesh::BlockMesh<3> mesh;
      add_box(mesh, {0.2, 0.4, 0.2}, on_edge, true);
      const BlockId block = add_box(mesh, {0.1, 0.1, 0.1}, {-0.2 - 0.00125 * phase, 0, 0.051}, false, {3, 0, 0});
      SettleOptions options = for_time(0.125);
      options.gravity = {0, 0, -1e-6};
      const Pose pose = settle(mesh, material(0.5, restitution), options).poses[block];
      EXPECT_NEAR(pose.translation.x(), 3 * 0.125, 1e-9) << phase;
      EXPECT_LT(pose.translation.tail<2>().norm(), 1e-7) << phase;
      EXPECT_LT(pose.rotation.vec().norm(), 1e-9) << phase;
    }
  }
}

// A ledge that is no rounding stops it.
TEST(Passing, ABlockIsStoppedByAStep) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {2, 2, 0.1}, {-1, 0, -0.05}, true);
  add_box(mesh, {2, 2, 0.1}, {1, 0, -0.04}, true);
  const BlockId block = add_box(mesh, {0.1, 0.1, 0.02}, {-0.2, 0, 0.01}, false, {3, 0, 0});
  EXPECT_LT(settle(mesh, material(0), for_time(0.25)).poses[block].translation.x(), 0.151);
}

// In closed form, in steps that are longer than the shelf is thick.
TEST(Passing, NothingFallsThroughAShelfAfterALongFall) {
  for (const double height : {2.0, 5.0, 5.03, 8.0, 20.0}) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {1, 1, 0.1}, {0, 0, -2.05}, true);
    add_box(mesh, {0.1, 0.1, 0.002}, {0, 0, -0.001}, true);
    const BlockId block = add_box(mesh, {0.01, 0.01, 0.01}, {0, 0, height + 0.005}, false);
    const auto packing = settle(mesh, material(0.5), for_time(std::sqrt(2 * height / g) + 0.1));
    EXPECT_NEAR(packing.poses[block].translation.z(), -height, 1e-3) << height;
  }
}

// Plates that fall on each other, by nine times their thickness a step.
TEST(Passing, NoPlateFallsThroughAnotherUnseen) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  int passed = 0;
  for (int i = 0; i < 40; ++i) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {2, 2, 0.2}, {0, 0, -0.1}, true);
    std::array<BlockId, 3> plates{};
    std::array<Vector3d, 3> start;
    for (std::size_t p = 0; p < plates.size(); ++p) {
      const Eigen::Quaterniond tilt(1, 0.15 * part(random), 0.15 * part(random), 0.3 * part(random));
      start[p] = {0, 0, 1 + 0.1 * static_cast<double>(p)};
      plates[p] = add_box(mesh, {0.2, 0.2, 0.002}, Pose{start[p], tilt.normalized()}, false);
    }
    const auto packing = settle(mesh, material(0.6), for_time(1));
    const auto at = [&](std::size_t p) { return packing.poses[plates[p]] * start[p]; };
    for (std::size_t p = 0; p + 1 < plates.size(); ++p) {
      const bool beside = (at(p + 1) - at(p)).head<2>().norm() > 0.05;
      if (beside || at(p + 1).z() > at(p).z()) continue;
      ++passed;
      EXPECT_GT(packing.settled->deepest_overlap, 0.5) << i;
    }
  }
  EXPECT_GT(passed, 0) << "the steps are short enough, and the test sees nothing";
}

// Flat on each other, and by up to thirty times the thickness of both a step.
TEST(Passing, ATileIsHeldByAThinShelfHoweverFastItComes) {
  for (const double speed : {0.0, 6.0, 10.0, 15.0, 24.0, 40.0}) {
    for (int i = 0; i < 12; ++i) {
      mesh::BlockMesh<3> mesh;
      add_box(mesh, {1, 1, 0.002}, {0, 0, -0.001}, true);
      const double gap = speed > 0 ? 0.002 + 0.0037 * i : 1.6 + 0.083 * i;
      const BlockId tile = add_box(mesh, {0.3, 0.3, 0.003}, {0, 0, 0.0015 + gap}, false, {0, 0, -speed});
      const auto packing = settle(mesh, material(0.5), for_time(speed > 0 ? 0.1 : 1));
      EXPECT_NEAR(gap + packing.poses[tile].translation.z(), 0, 1e-5) << speed << " m/s from " << gap;
    }
  }
}

TEST(Passing, NoCubeFliesThroughAFloorAtKilometresASecond) {
  for (int i = 0; i < 5; ++i) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {1, 1, 0.2}, {0, 0, -0.1}, true);
    const double gap = 0.3 + 0.77 * i;
    const BlockId cube = add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.05 + gap}, false, {0, 0, -1e4});
    const auto packing = settle(mesh, material(0.5), for_time(8.0 / 240));
    EXPECT_NEAR(gap + packing.poses[cube].translation.z(), 0, 1e-5) << gap;
  }
}

// Beside the rim as the step begins, over it by 5 mm as the tile comes down to it, and below the shelf as the step ends.
TEST(Passing, NoTileFliesThroughAShelfFromBesideItUnseen) {
  for (int i = 0; i < 8; ++i) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {1, 1, 0.002}, {0, 0, -0.001}, true);
    const Vector3d start(-0.651 - 0.0005 * i, 0, 0.004 + 0.0004 * i), velocity(10, 0, -4);
    const BlockId tile = add_box(mesh, {0.3, 0.3, 0.003}, start, false, velocity);
    const auto packing = settle(mesh, material(0.5), for_time(4.0 / 240));
    const double flown = -4 * 4.0 / 240;
    EXPECT_FALSE(packing.poses[tile].translation.z() < flown && packing.settled->deepest_overlap < 0.5) << i;
    EXPECT_GT(packing.poses[tile].rotation.vec().norm(), 1e-3) << "it strikes with its rim";
  }
}

// At three sizes a step, in any attitude: whatever hits leaves its path, or the run says how deep it was.
TEST(Passing, NothingFliesThroughABlockUnseen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 200; ++i) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {1, 1, 0.1}, {0, 0, -1}, true);
    add_box(mesh, {0.005, 0.005, 0.005}, {0, 0, 0}, true);
    const Pose start{{0.002 * part(random), 0.002 * part(random), 0.03 + 0.01 * part(random)},
                     Eigen::Quaterniond(part(random), part(random), part(random), part(random)).normalized()};
    const Vector3d velocity = 4 * Vector3d(0.05 * part(random), 0.05 * part(random), -1).normalized();
    const BlockId block = add_box(mesh, {0.005, 0.005, 0.005}, start, false, velocity);
    const auto packing = settle(mesh, material(0.5), for_time(8.0 / 240));
    const double turned = packing.poses[block].rotation.vec().norm();
    const bool flew_on = turned < 1e-9 && std::abs(packing.poses[block].translation.z() + 4.0 * 8 / 240) < 0.007;
    EXPECT_FALSE(flew_on && packing.settled->deepest_overlap < 0.5) << i;
  }
}

}  // namespace
}  // namespace scree::rigid
