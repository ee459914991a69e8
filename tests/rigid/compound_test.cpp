// Blocks that are not convex: an L that stands on its foot with the upper limb overhanging.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/threads.h"
#include "engine/packing/penetration.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using Eigen::Vector3d;
using testing::add_box;
using testing::for_time;
using testing::g;
using testing::material;
using testing::plate;

constexpr double width = 0.1;  // of foot and limb [m]

// The lower side of the foot, a square, begins at `corner`; the limb above it is `limb` long.
BlockId add_l(mesh::BlockMesh<3>& mesh, double limb, const Vector3d& corner) {
  const BlockId foot = add_box(mesh, {width, width, width}, corner + Vector3d::Constant(width / 2), false);
  add_box(mesh, {limb, width, width}, corner + Vector3d(limb / 2, width / 2, 1.5 * width), false);
  Table<BlockId, mesh::Block> blocks;
  for (std::size_t i = 0; i + 1 < mesh.blocks.size(); ++i) blocks.push_back(mesh.blocks[BlockId{i}]);
  mesh.blocks = std::move(blocks);
  mesh.blocks[foot].nodes = {mesh.nodes.size() - 16, mesh.nodes.size()};
  mesh.blocks[foot].elements = {mesh.elements.size() - 12, mesh.elements.size()};
  return foot;
}

// Its centre of mass is above the foot if the limb is shorter than 2.4 widths, for which it is at its edge.
TEST(Compounds, StandWhereTheirCentreOfMassIsAboveTheirFoot) {
  mesh::BlockMesh<3> mesh = plate();
  add_l(mesh, 2.2 * width, {0, 0, 0.001});
  const auto packing = settle(mesh, material(0.6), SettleOptions());
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_LT(packing.settled->simulated_time, 1);
  EXPECT_NEAR(packing.settled->top, 2 * width, 1e-6);
  EXPECT_LT(packing.settled->max_penetration, 1e-7);
}

// It tips about an edge of its foot until the far lower edge of the limb is down, 2 widths along and one up; the limb's other
// upper edge is then (1 + 2 * 2) / sqrt(5) widths high.
TEST(Compounds, TipOntoTwoEdgesAndRestThereWithoutOverlap) {
  mesh::BlockMesh<3> mesh = plate();
  add_l(mesh, 3 * width, {0, 0, 0.001});
  const auto packing = settle(mesh, material(0.6), SettleOptions());
  EXPECT_TRUE(packing.settled->at_rest);
  EXPECT_LT(packing.settled->simulated_time, 2);
  EXPECT_NEAR(packing.settled->top, std::sqrt(5.0) * width, 1e-6);
  EXPECT_LT(packing.settled->max_penetration, 1e-7);
}

// A fixed plate of 20 x 4 x 2 cells of 0.1 m, its top at z = 0, in tetrahedra that share their nodes. A cell is left out at the
// far end, so that it is not convex.
mesh::BlockMesh<3> dented_plate() {
  constexpr double cell = 0.1;
  constexpr std::array<int, 3> cells{20, 4, 2};
  mesh::BlockMesh<3> mesh;
  const BodyId body = mesh.bodies.push_back({"plate", MaterialId{0}, true, Vector3d::Zero()});
  const auto node = [&](int x, int y, int z) { return NodeId((z * (cells[1] + 1) + y) * (cells[0] + 1) + x); };
  for (int z = 0; z <= cells[2]; ++z) {
    for (int y = 0; y <= cells[1]; ++y) {
      for (int x = 0; x <= cells[0]; ++x) mesh.nodes.push_back(cell * Vector3d(x, y - cells[1] / 2.0, z - cells[2]));
    }
  }
  for (int z = 0; z < cells[2]; ++z) {
    for (int y = 0; y < cells[1]; ++y) {
      for (int x = 0; x < cells[0]; ++x) {
        if (x + 1 == cells[0] && y == 0 && z + 1 == cells[2]) continue;
        const auto corner = [&](int i) { return node(x + (i & 1), y + ((i >> 1) & 1), z + ((i >> 2) & 1)); };
        for (const auto& [a, b] : {std::pair{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}) {
          mesh.elements.push_back({corner(0), corner(a), corner(b), corner(7)});
        }
      }
    }
  }
  mesh.blocks.push_back({body, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
  return mesh;
}

TEST(Compounds, LetABlockSlideOverTheirElementsAsOverASolid) {
  mesh::BlockMesh<3> mesh = dented_plate();
  const BlockId box = add_box(mesh, {0.1, 0.1, 0.1}, {0.2, 0.013, 0.05}, false, {2.2, 0, 0});
  const Pose pose = settle(mesh, material(0.3), for_time(1)).poses[box];
  const double way = 2.2 * 2.2 / (2 * 0.3 * g);
  EXPECT_NEAR(pose.translation.x(), way, 2.2 / 240) << "the first step slows it down as a whole";
  EXPECT_LT(pose.translation.tail<2>().norm(), 1e-9);
  EXPECT_LT(pose.rotation.vec().norm(), 1e-9);
}

// Where neither piece has a face of a surface in the plane between them, an overlap by rounding is none.
TEST(Compounds, SlideOverEachOtherWithoutBeingStoppedAtSeams) {
  for (const double shift : {0.0, 0.013, 0.05}) {
    mesh::BlockMesh<3> mesh = dented_plate();
    const BlockId l = add_l(mesh, 2 * width, {0.2, shift - 0.05, 0});
    mesh.bodies[mesh.blocks[l].body].velocity = {1.2, 0, 0};
    const Pose pose = settle(mesh, material(0), for_time(0.5)).poses[l];
    EXPECT_NEAR(pose.translation.x(), 0.6, 1e-8) << shift;
    EXPECT_LT(pose.translation.tail<2>().norm(), 1e-9) << shift;
    EXPECT_LT(pose.rotation.vec().norm(), 1e-9) << shift;
  }
}

TEST(Compounds, AreStoppedHoweverFastTheyCome) {
  mesh::BlockMesh<3> mesh = plate();
  const BlockId l = add_l(mesh, 2 * width, {0, 0, 0.5});
  mesh.bodies[mesh.blocks[l].body].velocity = {0, 0, -30};
  const auto packing = settle(mesh, material(0.6), for_time(0.1));
  EXPECT_LT(packing.settled->deepest_overlap, 1e-3) << "a step goes 0.125 m";
}

TEST(Compounds, RestOnEachOtherTheSameForAnyNumberOfThreads) {
  std::vector<Pose> first;
  for (const int threads : {1, 3}) {
    use_threads(threads);
    mesh::BlockMesh<3> mesh = plate();
    for (int i = 0; i < 4; ++i) add_l(mesh, 2 * width, {0.03 * i, 0.02 * i, 0.01 + 0.25 * i});
    const auto packing = settle(mesh, material(0.6), SettleOptions());
    EXPECT_TRUE(packing.settled->at_rest);
    EXPECT_LT(packing.settled->max_penetration, 1e-3 * width);
    if (first.empty()) first.assign(packing.poses.begin(), packing.poses.end());
    for (const BlockId block : packing.poses.ids()) {
      EXPECT_EQ(packing.poses[block].translation, first[block.index()].translation);
      EXPECT_EQ(packing.poses[block].rotation.coeffs(), first[block.index()].rotation.coeffs());
    }
  }
  use_threads(available_processors());
}

}  // namespace
}  // namespace scree::rigid
