// Coulomb's friction whatever the heading, and a fall to which nothing gives energy.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/rigid/settle.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;
using testing::add_box;
using testing::for_time;
using testing::g;
using testing::material;

// A block on a level plate under a gravity that pulls along it, too: what a slope of this angle does, down the heading. Its way
// [m].
Vector3d way_on_slope(double angle, double heading, double friction, double time, double drag = 0) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {8, 8, 0.1}, {0, 0, -0.05}, true);
  add_box(mesh, {0.2, 0.2, 0.05}, {0, 0, 0.025}, false);
  SettleOptions options = for_time(time);
  options.viscous_damping = drag;
  options.gravity = g * Vector3d(std::sin(angle) * std::cos(heading), std::sin(angle) * std::sin(heading), -std::cos(angle));
  const Vector3d start(0, 0, 0.025);
  return settle(mesh, material(friction), options).poses[BlockId{1}] * start - start;
}

TEST(Friction, IsTheSameDownEveryHeading) {
  const double angle = 25 * M_PI / 180;
  for (const double degrees : {0.0, 22.5, 30.0, 45.0, 60.0, 100.0}) {
    const double heading = degrees * M_PI / 180;
    const Vector3d down(std::cos(heading), std::sin(heading), 0);
    const Vector3d held = way_on_slope(angle, heading, 1.02 * std::tan(angle), 1);
    EXPECT_LT(held.norm(), 1e-4) << degrees;
    const double friction = 0.3;
    const Vector3d slid = way_on_slope(angle, heading, friction, 1);
    const double way = 0.5 * g * (std::sin(angle) - friction * std::cos(angle));
    EXPECT_NEAR(slid.dot(down) / way, 1, 0.01) << degrees;
    EXPECT_LT((slid - slid.dot(down) * down).norm(), 0.002 * way) << degrees;
  }
}

// dv/dt = g (sin - mu cos) - c v.
TEST(Friction, OfABlockThatStartsAtRestLeavesDragItsPart) {
  const double angle = 25 * M_PI / 180, friction = 0.3, drag = 2;
  const double slid = way_on_slope(angle, 0, friction, 1, drag).x();
  const double end_speed = g * (std::sin(angle) - friction * std::cos(angle)) / drag;
  EXPECT_NEAR(slid / (end_speed * (1 - (1 - std::exp(-drag)) / drag)), 1, 0.02);
}

TEST(Friction, StopsABlockAfterTheSameWayWhateverItsHeading) {
  const double friction = 0.5, speed = 2;
  for (const double degrees : {0.0, 30.0, 45.0}) {
    const Vector3d way(std::cos(degrees * M_PI / 180), std::sin(degrees * M_PI / 180), 0);
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
    add_box(mesh, {0.2, 0.2, 0.05}, {0, 0, 0.025}, false, speed * way);
    const Pose end = settle(mesh, material(friction), {}).poses[BlockId{1}];
    const double distance = speed * speed / (2 * friction * g);
    EXPECT_NEAR((end * Vector3d(0, 0, 0.025)).dot(way) / distance, 1, 0.02) << degrees;
  }
}

// Nothing gives it energy, so its middle never gets higher than where it was let go.
TEST(Rebound, ACubeThatTumblesAndReboundsNeverClimbs) {
  const Vector3d axis = Vector3d(1, 0.3, 0.2).normalized();
  for (const double restitution : {0.7, 0.9}) {
    for (const double step : {1e-3, 4e-3}) {
      mesh::BlockMesh<3> mesh;
      add_box(mesh, {40, 40, 0.2}, {0, 0, -0.1}, true);
      const Pose start{{0, 0, 0.3}, Eigen::Quaterniond(Eigen::AngleAxisd(20 * M_PI / 180, axis))};
      add_box(mesh, {0.2, 0.2, 0.2}, start, false);
      SettleOptions options = for_time(4);
      options.step = step;
      options.frame_interval = 0.01;
      double highest = 0;
      settle(mesh, material(0.6, restitution), options, [&](double, const Table<BlockId, Pose>& poses) {
        highest = std::max(highest, (poses[BlockId{1}] * start.translation).z());
      });
      EXPECT_LE(highest, start.translation.z() + 1e-9) << restitution << " " << step;
    }
  }
}

// A tilt of a degree too far would give a needle that spins about its length a multiple of its energy, step by step.
TEST(Rebound, NeedlesThatFallNeverClimbAndComeToLie) {
  for (const double degrees : {5.0, 35.0, 60.0, 85.0}) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {4, 4, 0.1}, {0, 0, -0.05}, true);
    const Vector3d axis = Vector3d(0.3, 1, 0.2).normalized();
    const Pose start{{0, 0, 0.3}, Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180, axis))};
    add_box(mesh, {0.1, 0.002, 0.002}, start, false);
    SettleOptions options = for_time(4);
    options.frame_interval = 0.01;
    double highest = 0, last = 0;
    settle(mesh, material(0.5, 0), options, [&](double, const Table<BlockId, Pose>& poses) {
      last = (poses[BlockId{1}] * start.translation).z();
      highest = std::max(highest, last);
    });
    EXPECT_LE(highest, start.translation.z() + 1e-9) << degrees;
    EXPECT_NEAR(last, 0.001, 1e-4) << degrees;
  }
}

// It flies away from a wall, or from a block of eight times its mass, at what comes towards it: all three meet in one step.
// What hits it flies back with e times the speed that it was stopped from, whatever stands behind, and no energy is gained.
TEST(Rebound, OfABlockThatIsHitBeforeAnotherIsThatOfTheTwoThatMeet) {
  for (const double restitution : {0.8, 0.9, 1.0}) {
    for (const bool wall : {true, false}) {
      mesh::BlockMesh<3> mesh;
      add_box(mesh, {0.1, 0.2, 0.4}, {-0.05, 0, 0}, wall);
      add_box(mesh, {0.1, 0.1, 0.1}, {0.051, 0, 0}, false, {10, 0, 0});
      add_box(mesh, {0.1, 0.1, 0.1}, {0.161, 0, 0}, false, {-10, 0, 0});
      SettleOptions options = for_time(2.5 / 240);
      options.gravity.setZero();
      options.frame_interval = options.step;
      std::vector<Vector3d> at;
      settle(mesh, material(0, restitution), options, [&](double, const Table<BlockId, Pose>& poses) {
        const auto x = [&](std::size_t block) { return poses[BlockId{block}].translation.x(); };
        at.emplace_back(x(0), x(1), x(2));
      });
      ASSERT_GE(at.size(), 2u);
      const Vector3d speeds = (at[1] - at[0]) / options.step;
      EXPECT_NEAR(speeds[2], 10 * restitution, 0.01) << wall;
      EXPECT_LE(speeds.cwiseAbs2().dot(Vector3d(8, 1, 1)), 200.01) << restitution << wall;
    }
  }
}

}  // namespace
}  // namespace scree::rigid
