#include "engine/packing/remaining.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/mesh/make_blocks.h"

namespace scree::packing {
namespace {

mesh::BodySpec body_at(const std::string& name, mesh::Shape shape, const Eigen::Vector3d& place) {
  mesh::BodySpec body;
  body.name = name;
  body.shape = std::move(shape);
  body.mesh_size = 0.5;
  body.arrangement = mesh::AtPoses{{Pose{place, Eigen::Quaterniond::Identity()}}};
  return body;
}

std::vector<mesh::BodySpec> three_bodies() {
  mesh::BodySpec cells = body_at("cells", mesh::Box{.size = {1, 1, 1}}, {9, 0, 0});
  cells.cells = mesh::CellKind::hexahedron;
  return {body_at("first", mesh::Box{.size = {1, 2, 1}}, {0, 0, 0}), body_at("second", mesh::Sphere{.diameter = 1}, {3, 0, 0}),
          cells};
}

TEST(RemainingBlocks, AreThoseOfAPackingThatNeverHadTheLostOnes) {
  auto bodies = three_bodies();
  Packing<3> packing = unmoved(mesh::make_blocks<3>(bodies));
  packing.settled.emplace().lost_blocks = {BlockId{1}};
  packing.poses[BlockId{2}] = Pose{{1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))};
  const Remaining<3> left = remaining(packing);

  bodies.erase(bodies.begin() + 1);
  Packing<3> without = unmoved(mesh::make_blocks<3>(bodies));
  without.poses[BlockId{1}] = packing.poses[BlockId{2}];
  const auto expected = placed_mesh(without);
  EXPECT_EQ(left.mesh.nodes, expected.nodes);
  EXPECT_EQ(left.mesh.elements, expected.elements);
  ASSERT_EQ(left.mesh.blocks.size(), 2u);
  for (const BlockId block : expected.blocks.ids()) {
    EXPECT_EQ(left.mesh.blocks[block].nodes, expected.blocks[block].nodes);
    EXPECT_EQ(left.mesh.blocks[block].elements, expected.blocks[block].elements);
    EXPECT_EQ(left.mesh.blocks[block].cells, expected.blocks[block].cells);
    EXPECT_EQ(left.mesh.bodies[left.mesh.blocks[block].body].name, expected.bodies[expected.blocks[block].body].name);
  }
  ASSERT_EQ(left.mesh.cells.size(), expected.cells.size());
  for (const CellId cell : expected.cells.ids()) EXPECT_EQ(left.mesh.cells[cell].nodes, expected.cells[cell].nodes);
  ASSERT_EQ(left.mesh.surfaces.size(), expected.surfaces.size());
  for (std::size_t i = 0; i < expected.surfaces.size(); ++i) {
    EXPECT_EQ(left.mesh.surfaces[i].nodes, expected.surfaces[i].nodes);
    const auto name = [](const auto& mesh, SurfaceId id) { return mesh.surface_names[id].name; };
    EXPECT_EQ(name(left.mesh, left.mesh.surfaces[i].surface), name(expected, expected.surfaces[i].surface));
  }
}

TEST(RemainingBlocks, KnowTheirPlacesInThePacking) {
  Packing<3> packing = unmoved(mesh::make_blocks<3>(three_bodies()));
  packing.settled.emplace().lost_blocks = {BlockId{1}};
  const Remaining<3> left = remaining(packing);
  EXPECT_EQ(left.places.blocks, (Table<BlockId, BlockId>({BlockId{0}, BlockId{2}})));
  Eigen::VectorXd heights(static_cast<Eigen::Index>(left.mesh.nodes.size()));
  for (const NodeId node : left.mesh.nodes.ids()) heights[static_cast<Eigen::Index>(node.index())] = left.mesh.nodes[node].z();
  const std::vector<double> all = left.places.in_packing(heights);
  ASSERT_EQ(all.size(), packing.mesh.nodes.size());
  for (const BlockId block : packing.mesh.blocks.ids()) {
    for (const NodeId node : packing.mesh.blocks[block].nodes) {
      if (block == BlockId{1}) {
        EXPECT_TRUE(std::isnan(all[node.index()]));
      } else {
        EXPECT_EQ(all[node.index()], packing.mesh.nodes[node].z());
      }
    }
  }
}

TEST(RemainingBlocks, AreAllIfNoneIsLost) {
  const Packing<3> packing = unmoved(mesh::make_blocks<3>(three_bodies()));
  const Remaining<3> left = remaining(packing);
  EXPECT_EQ(left.mesh.nodes, packing.mesh.nodes);
  EXPECT_EQ(left.places.blocks.size(), 3u);
}

}  // namespace
}  // namespace scree::packing
