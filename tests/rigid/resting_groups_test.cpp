// Groups of blocks that came to rest sleep until something touches them.
#include <algorithm>

#include <gtest/gtest.h>

#include "engine/rigid/resting_groups.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;

using testing::add_box;

constexpr double step = 1.0 / 240;
const Vector3d cube(0.1, 0.1, 0.1);

mesh::BlockMesh<3> floor_only() {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {20, 20, 0.1}, {0, 0, -0.05}, true);
  return mesh;
}

// Steps of a fall in which what comes to rest is put to sleep.
class Fall {
 public:
  Fall(const mesh::BlockMesh<3>& mesh, double friction, const SettleOptions& options = {})
      : world(mesh, testing::material(friction), options),
        damping_(world, options.gravity),
        groups_(world, options, 0.1, 0),
        local_damping_(options.local_damping) {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      damping_.slow_down(world, local_damping_, 0, step);
      world.step(step, 40);
      damping_.observe(world, step);
      groups_.observe(world, damping_, ++steps_ * step);
    }
  }

  World world;

 private:
  Damping damping_;
  RestingGroups groups_;
  double local_damping_;
  int steps_ = 0;
};

TEST(RestingGroups, ABlockAtRestSleepsWhileAnotherSlides) {
  mesh::BlockMesh<3> mesh = floor_only();
  const BlockId rests = add_box(mesh, cube, {0, 0, 0.05}, false);
  const BlockId slides = add_box(mesh, cube, {0, 1, 0.05}, false, {0.5, 0, 0});
  Fall fall(mesh, 0);
  fall.run(59);
  EXPECT_FALSE(fall.world.asleep(rests));  // the first window is of sixty steps
  fall.run(1);
  EXPECT_TRUE(fall.world.asleep(rests));
  fall.run(240);
  EXPECT_TRUE(fall.world.asleep(rests));
  EXPECT_FALSE(fall.world.asleep(slides));
  EXPECT_NEAR(fall.world.poses()[slides].translation.x(), 0.5 * 300 * step, 1e-9);
}

TEST(RestingGroups, OneBlockAtRestAmongManyThatSlideIsNotWorthSleeping) {
  mesh::BlockMesh<3> mesh = floor_only();
  const BlockId rests = add_box(mesh, cube, {0, -1, 0.05}, false);
  for (int i = 0; i < 24; ++i) add_box(mesh, cube, {0, 0.2 * i, 0.05}, false, {0.5, 0, 0});
  Fall fall(mesh, 0);
  fall.run(120);
  EXPECT_FALSE(fall.world.asleep(rests));
}

TEST(RestingGroups, WhatSlidesKeepsWhatItTouchesAwake) {
  mesh::BlockMesh<3> mesh = floor_only();
  const BlockId below = add_box(mesh, {2, 0.2, 0.1}, {0, 0, 0.05}, false);
  add_box(mesh, cube, {-0.8, 0, 0.15}, false, {0.5, 0, 0});
  const BlockId aside = add_box(mesh, cube, {0, 1, 0.05}, false);
  Fall fall(mesh, 0);
  fall.run(240);
  EXPECT_FALSE(fall.world.asleep(below));
  EXPECT_TRUE(fall.world.asleep(aside));
}

TEST(RestingGroups, NothingThatFallsOrRisesSleeps) {
  mesh::BlockMesh<3> mesh = floor_only();
  const BlockId thrown = add_box(mesh, cube, {0, 0, 1}, false, {0, 0, 0.5 * testing::g});
  SettleOptions options;
  options.rest_window = 3 * step;  // about the highest point
  Fall fall(mesh, 0, options);
  for (int i = 0; i < 240; ++i) {
    fall.run(1);
    EXPECT_FALSE(fall.world.asleep(thrown));
  }
}

// At the end of the window it lies where it lay at the beginning.
TEST(RestingGroups, AStoneThatBouncedOnWhatRestsKeepsItAwake) {
  mesh::BlockMesh<3> mesh = floor_only();
  const BlockId rests = add_box(mesh, {2, 2, 2}, {0, 0, 1}, false);
  const BlockId stone = add_box(mesh, {0.003, 0.003, 0.003}, {0, 0, 2.0015}, false, {0, 0, 0.48 * 0.25 * testing::g});
  Fall fall(mesh, 0.6);
  fall.run(60);
  EXPECT_NEAR((fall.world.poses()[stone].translation).norm(), 0, 1e-4);
  EXPECT_FALSE(fall.world.asleep(rests));
  fall.run(60);
  EXPECT_TRUE(fall.world.asleep(rests));
}

TEST(RestingGroups, ASleepingGroupIsPushedAwayLikeOneThatIsAwake) {
  // Nothing rubs or rebounds: the one that comes goes on with the lower of two at half its speed, fast or slow.
  for (const double speed : {1.0, 0.02}) {
    const double gap = speed;  // closed after a second
    mesh::BlockMesh<3> mesh = floor_only();
    const BlockId comes = add_box(mesh, cube, {-0.1 - gap, 0, 0.05}, false, {speed, 0, 0});
    const BlockId lower = add_box(mesh, cube, {0, 0, 0.05}, false);
    const BlockId upper = add_box(mesh, {0.06, 0.06, 0.02}, {0, 0, 0.11}, false);
    Fall fall(mesh, 0);
    SettleOptions restless;
    restless.rest_speed = 0;
    Fall awake(mesh, 0, restless);
    const auto advance = [&](int steps) {
      for (Fall* each : {&fall, &awake}) each->run(steps);
    };
    advance(200);
    EXPECT_TRUE(fall.world.asleep(lower));
    EXPECT_TRUE(fall.world.asleep(upper));
    advance(160);
    EXPECT_FALSE(fall.world.asleep(lower));
    EXPECT_FALSE(fall.world.asleep(upper));
    const auto poses = fall.world.poses(), expected = awake.world.poses();
    const double way = 0.5 * speed * (360 * step - 1);
    EXPECT_NEAR(poses[lower].translation.x(), way, 0.02 * gap);
    EXPECT_NEAR(poses[comes].translation.x(), gap + way, 0.02 * gap);
    for (const BlockId block : {comes, lower, upper}) {
      EXPECT_LT((poses[block].translation - expected[block].translation).norm(), 1e-3 * gap);
    }
  }
}

// Towers of two cubes, and far from them a loose heap that falls.
struct TowersAndHeap {
  mesh::BlockMesh<3> mesh = floor_only();
  std::size_t towers_end;  // block

  TowersAndHeap() {
    for (int i = 0; i < 6; ++i) {
      for (const double height : {0.05, 0.15}) add_box(mesh, cube, {-6, 0.15 * i, height}, false);
    }
    towers_end = mesh.blocks.size();
    for (int i = 0; i < 27; ++i) {
      const Vector3d corner(0.11 * (i % 3) + 0.013 * (i / 9), 0.11 * (i / 3 % 3), 0.3 + 0.11 * (i / 9));
      testing::add_tetrahedron(
          mesh, {corner, corner + Vector3d(0.1, 0, 0), corner + Vector3d(0, 0.1, 0.01), corner + Vector3d(0.01, 0, 0.1)});
    }
  }
};

TEST(RestingGroups, WhatSleepsStaysWhereItIsAndTheRestMovesToTheBitAsIfNothingSlept) {
  const TowersAndHeap scene;
  World asleep(scene.mesh, testing::material(0.6), {}), awake(scene.mesh, testing::material(0.6), {});
  const auto advance = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      for (World* world : {&asleep, &awake}) world->step(step, 40);
    }
  };
  advance(60);
  const auto is_tower = [&](BlockId block) { return block.index() < scene.towers_end; };
  for (const auto& group : asleep.touching_groups()) {
    if (is_tower(group[0])) asleep.put_to_sleep(group);
  }
  const auto before = asleep.poses();
  advance(240);
  const auto poses = asleep.poses(), expected = awake.poses();
  double way = 0;
  for (const BlockId block : asleep.free_blocks()) {
    const Pose& should = is_tower(block) ? before[block] : expected[block];
    EXPECT_EQ(poses[block].translation, should.translation);
    EXPECT_EQ(poses[block].rotation.coeffs(), should.rotation.coeffs());
    EXPECT_EQ(asleep.asleep(block), is_tower(block));
    if (!is_tower(block)) way = std::max(way, (should.translation - before[block].translation).norm());
  }
  EXPECT_GT(way, 0.1);
}

TEST(RestingGroups, APileOfWhichPartsSleepComesToRestAndTellsTheForcesOfAll) {
  const TowersAndHeap scene;
  SettleOptions options;
  options.local_damping = 0.5;
  const auto packing = settle(scene.mesh, testing::material(0.6), options);
  ASSERT_TRUE(packing.settled->at_rest);
  EXPECT_NE(packing.settled->criterion.find(" blocks came to rest before"), std::string::npos) << packing.settled->criterion;
  EXPECT_LT(packing.settled->max_penetration, 0.01 * packing.settled->mean_edge);
  const double weight = 1e-3 * 2500 * testing::g;  // of a cube [N]
  for (std::size_t i = 1; i < scene.towers_end; ++i) {
    EXPECT_LT(packing.settled->net_force[BlockId{i}], 5e-3 * weight);
    EXPECT_LT(packing.poses[BlockId{i}].translation.norm(), 1e-4);
  }
}

}  // namespace
}  // namespace scree::rigid
