#include "engine/rigid/settle.h"
#include "engine/base/threads.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cmath>
#include <stdexcept>

#include "engine/base/check.h"
#include "engine/packing/penetration.h"
#include "engine/rigid/scene_bounds.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;
using testing::add_box;
using testing::add_tetrahedron;
using testing::for_time;
using testing::g;
using testing::material;
using testing::plate;

Pose slope(double angle, double height) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  return {turn * Vector3d(0, 0, height), turn};
}

// Block 0 is the fixed slope, block 1 slides on it; its way down the slope [m].
double way_down(double angle, double friction, double time) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 1, 0.1}, slope(angle, -0.05), true);
  add_box(mesh, {0.2, 0.2, 0.1}, slope(angle, 0.05), false);
  const Pose pose = settle(mesh, material(friction), for_time(time)).poses[BlockId{1}];
  return (pose * slope(angle, 0.05).translation - slope(angle, 0.05).translation)
      .dot(slope(angle, 0).rotation * Vector3d::UnitX());
}

TEST(Settle, ABlockFallsAsGravityTellsIt) {
  mesh::BlockMesh<3> mesh = plate();
  add_tetrahedron(mesh, {Vector3d(0, 0, 2), Vector3d(0.1, 0, 2), Vector3d(0, 0.1, 2), Vector3d(0, 0, 2.1)});
  double checked = 0;
  settle(mesh, material(0.5), for_time(0.5), [&](double time, const Table<BlockId, Pose>& poses) {
    EXPECT_NEAR(poses[BlockId{1}].translation.z(), -g * time * time / 2, 1e-12);
    checked = time;
  });
  EXPECT_NEAR(checked, 0.5, 1e-12);
}

TEST(Settle, AStepwiseFallDiffersFromTheClosedFormByHalfAStepOnly) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 2}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {0.5, 0, 2}, false, {0, 0.1, 0});  // another start: nothing is skipped
  const SettleOptions options = for_time(0.5);
  const auto poses = settle(mesh, material(0.5), options).poses;
  const double symplectic = -g * 0.5 * (0.5 + options.step) / 2;
  EXPECT_NEAR(poses[BlockId{1}].translation.z(), symplectic, 1e-9);
  EXPECT_NEAR(poses[BlockId{2}].translation.y(), 0.05, 1e-9);
}

TEST(Settle, TheNetForceIsTheWeightOfABlockThatFallsAndNoneOnOneAtRest) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.05}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {0.5, 0, 20}, false, {0, 0.1, 0});
  const auto force = settle(mesh, material(0.5), for_time(0.5)).settled->net_force;
  const double weight = 2500 * 1e-3 * g;
  EXPECT_EQ(force[BlockId{0}], 0);
  EXPECT_NEAR(force[BlockId{1}], 0, 1e-6 * weight);
  EXPECT_NEAR(force[BlockId{2}], weight, 1e-9 * weight);
}

TEST(Settle, DampedFallsFollowTheirEquations) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 2}, false);
  SettleOptions options = for_time(0.5);
  options.local_damping = 0.7;
  EXPECT_NEAR(settle(mesh, material(0.5), options).poses[BlockId{1}].translation.z(), -0.3 * g * 0.25 / 2, 1e-12);
  options.local_damping = 0;
  options.viscous_damping = 20;
  const double way = g / 20 * (0.5 - (1 - std::exp(-10.0)) / 20);
  EXPECT_NEAR(settle(mesh, material(0.5), options).poses[BlockId{1}].translation.z(), -way, 1e-12);
}

TEST(Settle, StepwiseDampingApproachesTheSameFalls) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 2}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {0.5, 0, 2}, false, {0, 0.01, 0});  // another start: nothing is skipped
  SettleOptions options = for_time(0.5);
  options.local_damping = 0.7;
  // The first step has no motion to damp: one step's worth of speed too much, for all of the time.
  const double way = 0.3 * g * 0.25 / 2;
  const double first_step = 0.7 * g * options.step * 0.5;
  EXPECT_NEAR(settle(mesh, material(0.5), options).poses[BlockId{1}].translation.z(), -way - first_step, 0.01 * way);
  options.local_damping = 0;
  options.viscous_damping = 20;
  const double slow_way = g / 20 * (0.5 - (1 - std::exp(-20 * 0.5)) / 20);
  EXPECT_NEAR(settle(mesh, material(0.5), options).poses[BlockId{1}].translation.z(), -slow_way, 0.02 * slow_way);
}

TEST(Settle, ACubeComesToRestOnAPlate) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.25}, false);
  const auto packing = settle(mesh, material(0.5), {});
  const auto& report = *packing.settled;
  EXPECT_TRUE(report.at_rest) << report.criterion;
  EXPECT_NEAR((packing.poses[BlockId{1}] * Vector3d(0, 0, 0.25)).z(), 0.05, 1e-4 * 0.1);
  EXPECT_NEAR(report.top, 0.1, 1e-4 * 0.1);
  EXPECT_LT(report.max_penetration, 1e-4 * 0.1);
  EXPECT_LT(report.unbalanced_force, 0.01);
  EXPECT_TRUE(report.lost_blocks.empty());
}

TEST(Settle, BlocksThatKeepAClearanceComeToRestThatFarApartAndDoNotOverlap) {
  mesh::BlockMesh<3> mesh = plate();
  for (int i = 0; i < 3; ++i) add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.06 + 0.105 * i}, false);
  SettleOptions options;
  options.clearance = 2e-4;
  const packing::Packing<3> packing = settle(mesh, material(0.6), options);
  const auto& report = *packing.settled;
  EXPECT_TRUE(report.at_rest) << report.criterion;
  EXPECT_NEAR(report.top, 0.3 + 3 * options.clearance, 0.05 * options.clearance);
  EXPECT_EQ(report.max_penetration, 0);
}

TEST(Settle, AStackOfCubesStands) {
  mesh::BlockMesh<3> mesh = plate();
  for (int i = 0; i < 5; ++i) add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.06 + 0.105 * i}, false);
  const auto packing = settle(mesh, material(0.6), {});
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_NEAR(packing.settled->top, 0.5, 1e-3 * 0.5);
  for (int i = 0; i < 5; ++i) {
    const Vector3d centre = packing.poses[BlockId{std::size_t(i) + 1}] * Vector3d(0, 0, 0.06 + 0.105 * i);
    EXPECT_LT(centre.head<2>().norm(), 1e-3);
  }
}

TEST(Settle, ABlockStaysOnASlopeFlatterThanItsFrictionAngle) {
  EXPECT_NEAR(way_down(std::atan(0.55), 0.6, 1.0), 0, 1e-4);
}

TEST(Settle, ABlockSlidesDownASteeperSlopeWithTheClosedFormsAcceleration) {
  const double angle = std::atan(0.8);
  const double acceleration = g * (std::sin(angle) - 0.6 * std::cos(angle));
  EXPECT_NEAR(way_down(angle, 0.6, 1.0), acceleration / 2, 0.01 * acceleration / 2);
}

TEST(Settle, ASlidingBlockStopsWhereItsFrictionStopsIt) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.2, 0.2, 0.05}, {-0.5, 0, 0.025}, false, {2, 0, 0});
  const auto packing = settle(mesh, material(0.5), {});
  const double distance = 2.0 * 2.0 / (2 * 0.5 * g);
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_NEAR(packing.poses[BlockId{1}].translation.x(), distance, 0.02 * distance);
}

// One block meets another of twice its mass.
void expect_collision(double restitution, double clearance) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {0.1, 0.1, 0.1}, {-0.2, 0, 0}, false, {1, 0, 0});
  add_box(mesh, {0.2, 0.1, 0.1}, {0.2, 0, 0}, false);  // twice the mass
  SettleOptions options = for_time(0.5);
  options.gravity.setZero();
  options.clearance = clearance;
  const auto late = settle(mesh, material(0.5, restitution), options).poses;
  options.limit = 0.4;
  const auto early = settle(mesh, material(0.5, restitution), options).poses;
  const auto speed = [&](BlockId block, double x) {
    return ((late[block] * Vector3d(x, 0, 0)).x() - (early[block] * Vector3d(x, 0, 0)).x()) / 0.1;
  };
  const double v1 = speed(BlockId{0}, -0.2);
  const double v2 = speed(BlockId{1}, 0.2);
  EXPECT_NEAR(v1 + 2 * v2, 1, 1e-9);
  EXPECT_NEAR(v2 - v1, restitution, 1e-3);  // four points share the blow; the solver ends before they agree
}

TEST(Settle, ACollisionKeepsMomentumAndEnergyAsRestitutionSays) {
  for (const double restitution : {0.0, 0.5, 1.0}) expect_collision(restitution, 0);
}

TEST(Settle, ACollisionAcrossAClearanceIsTheSame) {
  for (const double restitution : {0.0, 0.5, 1.0}) expect_collision(restitution, 1e-3);
}

TEST(Settle, ABlockAtRestIsPushedAwayByOneThatComesLaterFastOrSlow) {
  // Nothing rubs or rebounds: two equal blocks go on together at half the speed of the one that came. The slow one moves less
  // in a step than a block at home may (homes.h).
  for (const double speed : {1.0, 0.02}) {
    const double gap = 0.5 * speed;  // closed after half a second
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {4, 2, 0.1}, {0, 0, -0.05}, true);
    const BlockId comes = add_box(mesh, {0.1, 0.1, 0.1}, {-0.1 - gap, 0, 0.05}, false, {speed, 0, 0});
    const BlockId rests = add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.05}, false);
    double before = 1;
    const auto packing = settle(mesh, material(0), for_time(1.5), [&](double time, const auto& poses) {
      if (time < 0.49) before = std::abs(poses[rests].translation.x());
    });
    EXPECT_LT(before, 1e-6 * gap);
    EXPECT_NEAR(packing.poses[rests].translation.x(), gap, 0.02 * gap);
    EXPECT_NEAR(packing.poses[comes].translation.x(), 2 * gap, 0.02 * gap);
  }
}

TEST(Settle, ALooseHeapKeepsItsMomentumWithoutGravity) {
  mesh::BlockMesh<3> mesh;
  const std::array<Vector3d, 4> corners{Vector3d(0, 0, 0), Vector3d(0.1, 0, 0), Vector3d(0.02, 0.1, 0),
                                        Vector3d(0, 0.01, 0.12)};
  add_tetrahedron(mesh, corners);
  add_box(mesh, {0.1, 0.1, 0.1}, {0.5, 0.06, 0.06}, false, {-2, 0, 0});
  add_box(mesh, {0.05, 0.1, 0.1}, {-0.3, 0.03, 0.02}, false, {1, 0, 0});
  SettleOptions options = for_time(0.5);
  options.gravity.setZero();
  const auto late = settle(mesh, material(0.5), options).poses;
  options.limit = 0.45;
  const auto early = settle(mesh, material(0.5), options).poses;
  const double tetrahedron = 0.1 * 0.1 * 0.12 / 6;
  Vector3d momentum = Vector3d::Zero();
  Vector3d centroid = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  momentum += tetrahedron * (late[BlockId{0}] * centroid - early[BlockId{0}] * centroid) / 0.05;
  momentum += 1e-3 * (late[BlockId{1}] * Vector3d(0.5, 0.06, 0.06) - early[BlockId{1}] * Vector3d(0.5, 0.06, 0.06)) / 0.05;
  momentum += 5e-4 * (late[BlockId{2}] * Vector3d(-0.3, 0.03, 0.02) - early[BlockId{2}] * Vector3d(-0.3, 0.03, 0.02)) / 0.05;
  EXPECT_LT((momentum - Vector3d(1e-3 * -2 + 5e-4, 0, 0)).norm(), 1e-9);
}

mesh::BlockMesh<3> heap() {
  mesh::BlockMesh<3> mesh = plate();
  for (int i = 0; i < 27; ++i) {
    const Vector3d corner(0.11 * (i % 3) + 0.013 * (i / 9), 0.11 * ((i / 3) % 3), 0.05 + 0.11 * (i / 9));
    add_tetrahedron(mesh,
                    {corner, corner + Vector3d(0.1, 0, 0), corner + Vector3d(0, 0.1, 0.01), corner + Vector3d(0.01, 0, 0.1)});
  }
  return mesh;
}

XXH64_hash_t hash_of(const Table<BlockId, Pose>& poses) {
  std::vector<double> numbers;
  for (const Pose& pose : poses) {
    for (int i = 0; i < 3; ++i) numbers.push_back(pose.translation[i]);
    for (int i = 0; i < 4; ++i) numbers.push_back(pose.rotation.coeffs()[i]);
  }
  return XXH64(numbers.data(), numbers.size() * sizeof(double), 0);
}

TEST(Settle, TheSameHeapSettlesToTheSameBits) {
  const auto first = settle(heap(), material(0.6), for_time(1));
  const auto second = settle(heap(), material(0.6), for_time(1));
  EXPECT_EQ(hash_of(first.poses), hash_of(second.poses));
}

TEST(Settle, SettlesToTheSameBitsForAnyNumberOfThreads) {
  // Enough pairs for every thread to look at some, and enough blocks for several slabs (row_batches.h).
  mesh::BlockMesh<3> mesh = plate();
  for (int i = 0; i < 1200; ++i) {
    const Vector3d corner(0.098 * (i % 10) - 0.5, 0.098 * (i / 10 % 10) - 0.5, 0.02 + 0.098 * (i / 100));
    add_tetrahedron(mesh,
                    {corner, corner + Vector3d(0.1, 0, 0), corner + Vector3d(0, 0.1, 0.01), corner + Vector3d(0.01, 0, 0.1)});
  }
  SettleOptions options = for_time(0.2);
  options.iterations = 5;
  std::vector<XXH64_hash_t> hashes;
  for (const int threads : {1, 2, 5}) {
    use_threads(threads);
    hashes.push_back(hash_of(settle(mesh, material(0.6), options).poses));
  }
  use_threads(available_processors());
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(Settle, AHeapComesToRestWithoutOverlapAndSaysSo) {
  SettleOptions options;
  options.local_damping = 0.7;
  const auto packing = settle(heap(), material(0.6), options);
  const auto& report = *packing.settled;
  EXPECT_TRUE(report.at_rest);
  EXPECT_LT(report.max_penetration, 0.01 * report.mean_edge);
  EXPECT_LT(report.mean_penetration, 0.001 * report.mean_edge);
  EXPECT_LT(report.max_displacement, 0.01 * report.mean_edge);
  EXPECT_LT(report.rms_speed, 1e-3);
}

TEST(Settle, AHeapStillMovingAtTheLimitIsNotAtRest) {
  SettleOptions options;
  options.limit = 0.3;
  const auto packing = settle(heap(), material(0.6), options);
  EXPECT_FALSE(packing.settled->at_rest);
  EXPECT_GT(packing.settled->max_speed, 1e-2);
}

TEST(Settle, DragAloneDoesNotMakeABlockThatSlidesCountAsResting) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {4, 1, 0.1}, slope(0.3, -0.05), true);
  add_box(mesh, {0.2, 0.2, 0.1}, slope(0.3, 0.05), false);
  SettleOptions options;
  options.limit = 1.5;
  options.viscous_damping = 239;
  EXPECT_FALSE(settle(mesh, material(0.1), options).settled->at_rest);
}

TEST(Settle, ABlockThatMissesThePlateIsLostAndNamed) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.1}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {1.5, 0, 0.1}, false);
  const auto packing = settle(mesh, material(0.6), {});
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_EQ(packing.settled->lost_blocks, std::vector<BlockId>{BlockId{2}});
  EXPECT_NEAR(packing.settled->top, 0.1, 1e-5);
  EXPECT_LT(packing.poses[BlockId{2}].translation.z(), -0.2);
}

TEST(Settle, BlocksThatAreLostInOnePlaceAreNotInEachOther) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.06}, false);
  for (int i = 0; i < 4; ++i) add_box(mesh, {0.1, 0.1, 0.1}, {1.5, 0, 0.1 + 0.2 * i}, false);
  const auto packing = settle(mesh, material(0.6), {});
  EXPECT_EQ(packing.settled->lost_blocks.size(), 4U);
  const mesh::BlockMesh<3> placed = packing::placed_mesh(packing);
  EXPECT_GT(packing::measure_penetration(packing::PieceSet(placed), 1e-4).max, 0.01);  // that is what this is about
  EXPECT_LT(packing.settled->max_penetration, 1e-5);
}

TEST(Settle, ABlockOfManyElementsThatIsNotConvexRestsOnItsFeet) {
  // A table: two legs and a top that share no nodes but touch, as one block.
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {-0.2, 0, 0.1}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {0.2, 0, 0.1}, false);
  add_box(mesh, {0.5, 0.1, 0.05}, {0, 0, 0.175}, false);
  mesh::BlockMesh<3> joined = mesh;
  joined.blocks = Table<BlockId, mesh::Block>();
  joined.blocks.push_back(mesh.blocks[BlockId{0}]);
  joined.blocks.push_back({mesh.blocks[BlockId{1}].body, {8, 32}, {6, 24}});
  const auto packing = settle(joined, material(0.6), {});
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_NEAR(packing.settled->top, 0.15, 1e-4);
}

TEST(Settle, HangingBlocksWaitForTheirTurn) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.9}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.5}, false);
  SettleOptions options;
  options.release_time = 1;
  double last_hung = 0;
  const auto packing = settle(mesh, material(0.6), options, [&](double time, const Table<BlockId, Pose>& poses) {
    if (poses[BlockId{1}].translation.z() == 0) last_hung = time;
    EXPECT_TRUE(time == 0 || poses[BlockId{2}].translation.z() < 0) << time;
  });
  EXPECT_NEAR(last_hung, 1.0 / 2, 0.03);
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_NEAR(packing.settled->top, 0.2, 1e-4);
}

TEST(Settle, TheFramesBeginAtZeroAndEndAtTheEnd) {
  mesh::BlockMesh<3> mesh = plate();
  add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.25}, false);
  std::vector<double> times;
  const auto packing = settle(mesh, material(0.5), {}, [&](double time, const auto&) { times.push_back(time); });
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), packing.settled->simulated_time);
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_LE(times[i] - times[i - 1], 0.02 + 1.0 / 240 + 1e-9);
}

TEST(Settle, AListenerMayStopIt) {
  EXPECT_THROW(settle(heap(), material(0.6), for_time(1), {}, [](double, double) { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

TEST(Settle, WrongOptionsAndMissingDensityAreRefused) {
  SettleOptions options;
  options.viscous_damping = 1000;
  EXPECT_THROW(settle(heap(), material(0.6), options), InputError);
  auto light = material(0.6);
  light[MaterialId{0}].density.reset();
  EXPECT_THROW(settle(heap(), light, {}), InputError);
}

// Its highest corners stand above the pedestal's very edge, by which rounding must not decide; a wall elsewhere is higher.
TEST(Settle, TheTopOfACubeFlushWithItsPedestalIsTheCubesHeight) {
  for (const double x : {0.0, 0.1, 0.3, 0.7, 1.1}) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {0.1, 0.1, 0.1}, {x, 0.7, -0.05}, true);
    add_box(mesh, {0.1, 0.1, 0.15}, {x + 0.5, 0.7, -0.025}, true);
    add_box(mesh, {0.1, 0.1, 0.1}, {x + 1e-9, 0.7, 0.05}, false);
    EXPECT_NEAR(pile_top(mesh, {0, 0, -9.81}, {}), 0.1, 1e-12) << x;
  }
}

}  // namespace
}  // namespace scree::rigid
