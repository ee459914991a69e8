// Blocks of a body that fly together are one body, and fall apart when they meet something.
#include <gtest/gtest.h>

#include "engine/mesh/make_blocks.h"
#include "engine/rigid/world.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;

using testing::g;

constexpr double step = 1.0 / 240;

// In hexahedra that are a block each.
mesh::BodySpec cube(const std::string& name, double size, double mesh_size, const Vector3d& centre, const Vector3d& velocity) {
  mesh::BodySpec body;
  body.name = name;
  body.shape = mesh::Box{.size = Vector3d::Constant(size)};
  body.arrangement = mesh::AtPoses{{{centre, Eigen::Quaterniond::Identity()}}};
  body.mesh_size = mesh_size;
  body.blocks = mesh::BlockRule::per_element;
  body.material = MaterialId{0};
  body.velocity = velocity;
  return body;
}

// A plate with its top at z = 0 and two cubes of 27 and 8 blocks above it that start unlike, so that no closed form skips their
// fall.
mesh::BlockMesh<3> thrown_cubes(double height) {
  mesh::BodySpec plate = cube("plate", 1, 1, {0, 0, -0.5}, Vector3d::Zero());
  plate.blocks = mesh::BlockRule::whole;
  plate.fixed = true;
  mesh::BodySpec large = cube("large", 0.3, 0.1, {-0.25, 0, 0.15 + height}, Vector3d::Zero());
  mesh::BodySpec small = cube("small", 0.2, 0.1, {0.25, 0, 0.6 + height}, {0.05, 0, 0});
  for (mesh::BodySpec* body : {&plate, &large, &small}) body->cells = mesh::CellKind::hexahedron;
  return mesh::make_blocks<3>({plate, large, small});
}

TEST(Flights, BlocksOfABodyThatFliesKeepTheirPlacesToEachOtherToTheBit) {
  const mesh::BlockMesh<3> mesh = thrown_cubes(0.1);
  World world(mesh, testing::material(0.5), {});
  constexpr int steps = 20;
  for (int i = 0; i < steps; ++i) world.step(step, 20);
  EXPECT_EQ(world.flying(), 2);
  EXPECT_EQ(world.mean_contact_force(step), 0);
  const double way = -g * step * step * steps * (steps + 1) / 2;  // of symplectic Euler
  const auto poses = world.poses();
  for (const BlockId block : mesh.blocks.ids()) {
    const Pose& pose = poses[block];
    const bool fixed = mesh.bodies[mesh.blocks[block].body].fixed;
    const bool small = mesh.bodies[mesh.blocks[block].body].name == "small";
    const Vector3d expected(small ? 0.05 * steps * step : 0, 0, fixed ? 0 : way);
    EXPECT_NEAR((pose.translation - expected).norm(), 0, 1e-14);
    EXPECT_NEAR(pose.rotation.vec().norm(), 0, 1e-14);
  }
}

TEST(Flights, ABodyThatMeetsSomethingFallsApartAndTheOtherFliesOn) {
  const mesh::BlockMesh<3> mesh = thrown_cubes(0.02);
  World world(mesh, testing::material(0.5), {});
  int steps = 0;
  while (world.flying() == 2 && steps < 100) {
    world.step(step, 20);
    ++steps;
  }
  EXPECT_EQ(world.flying(), 1);
  EXPECT_NEAR(steps * step, std::sqrt(2 * 0.02 / g), 3 * step);
  for (int i = 0; i < 10; ++i) world.step(step, 20);
  EXPECT_GT(world.mean_contact_force(step), 0);
  EXPECT_EQ(world.flying(), 1);
}

TEST(Flights, BlocksThatAreLetGoOneByOneDoNotFlyTogether) {
  SettleOptions options;
  options.release_time = 1;
  EXPECT_EQ(World(thrown_cubes(0.1), testing::material(0.5), options).flying(), 0);
}

}  // namespace
}  // namespace scree::rigid
