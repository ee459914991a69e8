#include "engine/output/probes.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/mesh/cells.h"
#include "engine/mesh/make_blocks.h"
#include "tests/output/support.h"

namespace scree::output {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A unit tetrahedron at the origin (block 0 of "rock") and one at x = 2 (block 1 of "stone").
mesh::BlockMesh<3> two_tets() {
  mesh::BlockMesh<3> mesh;
  const BodyId rock = mesh.bodies.push_back({"rock", MaterialId{0}, false, {}});
  const BodyId stone = mesh.bodies.push_back({"stone", MaterialId{0}, false, {}});
  add_block<3>(mesh, rock, unit_tet());
  add_block<3>(mesh, stone, unit_tet({2, 0, 0}));
  return mesh;
}

// f(x) = 3 + x + 2 y - 5 z at the nodes.
Eigen::VectorXd linear_field(const mesh::BlockMesh<3>& mesh) {
  Eigen::VectorXd values(mesh.nodes.size());
  for (const NodeId node : mesh.nodes.ids()) {
    values[node.index()] = 3 + mesh.nodes[node].dot(Point<3>(1, 2, -5));
  }
  return values;
}

std::string message(const mesh::BlockMesh<3>& mesh, const ProbeSpec& spec) {
  try {
    locate_probes(mesh, {spec});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Probes, ALinearFieldIsReadExactlyInTheBlockThatHoldsTheProbe) {
  const auto mesh = two_tets();
  const auto probes = locate_probes(mesh, {{"a", {0.2, 0.3, 0.1}}, {"b", {2.1, 0.05, 0.6}}});
  EXPECT_EQ(probes[0].block, BlockId{0});
  EXPECT_EQ(probes[1].block, BlockId{1});
  EXPECT_EQ(probes[1].moved, 0);
  EXPECT_NEAR(value_at(probes[0], linear_field(mesh)), 3 + 0.2 + 0.6 - 0.5, 1e-14);
  EXPECT_NEAR(value_at(probes[1], linear_field(mesh)), 3 + 2.1 + 0.1 - 3.0, 1e-14);
}

// In metres of a national grid, where coordinates are a nanometre apart.
TEST(Probes, FarFromTheOriginAPointInABlockIsInIt) {
  mesh::BlockMesh<3> mesh;
  mesh.bodies.push_back({"rock", MaterialId{0}, false, {}});
  const Point<3> site(412345.7, 5412345.8, 123.5);
  auto corners = unit_tet();
  for (auto& corner : corners) corner = site + 0.05 * corner;
  add_block<3>(mesh, BodyId{0}, corners);
  for (const double part : {0.0, 0.1, 0.3, 1.0 / 3}) {
    const Eigen::Vector3d point = site + 0.05 * Point<3>::Constant(part);
    EXPECT_EQ(locate_probes(mesh, {{"p", point}})[0].moved, 0) << part;
  }
}

// The message names the place that was asked for, and a reach that reaches.
TEST(Probes, WhatIsSuggestedForAPointInAVoidWorks) {
  const auto mesh = two_tets();
  const Eigen::Vector3d beside(-0.123456789, 0.2000001, 0.3000002);
  const std::string text = message(mesh, {"p", beside});
  EXPECT_THAT(text, HasSubstr("{point: [-0.123456789, 0.2000001, 0.3000002], reach: 0.13 m}"));
  EXPECT_NEAR(locate_probes(mesh, {{"p", beside, 0.13}})[0].moved, 0.123456789, 1e-12);
}

TEST(Probes, WorkInTwoDimensionsAndIgnoreZ) {
  mesh::BlockMesh<2> mesh;
  mesh.bodies.push_back({"bar", MaterialId{0}, false, {}});
  add_block<2>(mesh, BodyId{0}, {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)});
  const auto probes = locate_probes(mesh, {{"p", {0.25, 0.5, 99}}});
  EXPECT_NEAR(value_at(probes[0], Eigen::Vector3d(1, 2, 4)), 0.25 * 1 + 0.25 * 2 + 0.5 * 4, 1e-15);
}

// A box of hexahedra about the origin.
mesh::BlockMesh<3> grid(const Eigen::Vector3d& size, double mesh_size) {
  mesh::BodySpec body;
  body.name = "box";
  body.shape = mesh::Box{.size = size};
  body.mesh_size = mesh_size;
  body.cells = mesh::CellKind::hexahedron;
  body.material = MaterialId{0};
  return mesh::make_blocks<3>({body});
}

template <class Function>
Eigen::VectorXd at_nodes(const mesh::BlockMesh<3>& mesh, const Function& function) {
  Eigen::VectorXd field(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) field[node.value()] = function(mesh.nodes[node]);
  return field;
}

// A cubic field in a grid, at places inside, beside the surface and on a node.
TEST(Probes, ReadCubicFieldsExactlyInGridsIfAskedTo) {
  const auto mesh = grid({1, 1, 1}, 0.2);
  const auto cubic = [](const Eigen::Vector3d& at) {
    return 1 + at.x() * at.x() * at.y() - 2 * std::pow(at.z(), 3) + at.x() * at.y() * at.z();
  };
  const Eigen::VectorXd field = at_nodes(mesh, cubic);
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.07, 0.02, -0.11), Eigen::Vector3d(0.49, -0.45, 0.5), Eigen::Vector3d(0.1, 0.1, 0.1)}) {
    EXPECT_NEAR(value_at(locate_probes(mesh, {{"p", point}}, Reading::cubic)[0], field), cubic(point), 1e-10)
        << point.transpose();
  }
  const Eigen::Vector3d inside(0.07, 0.02, -0.11);
  EXPECT_GT(std::abs(value_at(locate_probes(mesh, {{"p", inside}})[0], field) - cubic(inside)), 1e-3);
}

// Across the bar two layers of nodes determine a line, and along it they are as many as a cubic needs.
TEST(Probes, ReadFieldsAlongABarOfOneCellAsFarAsItsLayersDetermineThem) {
  const auto mesh = grid({1, 0.1, 0.1}, 0.1);
  const auto along = [](const Eigen::Vector3d& at) { return 1 + std::pow(at.x(), 3) - at.x() * at.x() * at.y() + 2 * at.z(); };
  const Eigen::VectorXd field = at_nodes(mesh, along);
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.03, 0, 0), Eigen::Vector3d(-0.48, 0.02, -0.05)}) {
    EXPECT_NEAR(value_at(locate_probes(mesh, {{"p", point}}, Reading::cubic)[0], field), along(point), 1e-10);
  }
}

// As they do along the axes of the scene.
TEST(Probes, ReadFieldsAlongATurnedBarOfOneCellAsFarAsItsLayersDetermineThem) {
  auto mesh = grid({1, 0.1, 0.1}, 0.1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto along = [](const Eigen::Vector3d& at) { return 1 + std::pow(at.x(), 3) - at.x() * at.x() * at.y() + 2 * at.z(); };
  const Eigen::VectorXd field = at_nodes(mesh, along);
  for (const NodeId node : mesh.nodes.ids()) mesh.nodes[node] = turn * mesh.nodes[node];
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.03, 0, 0), Eigen::Vector3d(-0.48, 0.02, -0.05)}) {
    const Eigen::Vector3d point = turn * at * (1 - 1e-12);
    EXPECT_NEAR(value_at(locate_probes(mesh, {{"p", point, 1e-9}}, Reading::cubic)[0], field), along(at), 1e-9);
  }
}

// Two bars of four by four cells with a slot between them, joined at one end; each has a temperature of its own.
TEST(Probes, ReadNothingAcrossASlot) {
  auto mesh = grid({0.9, 0.4, 2}, 0.1);
  mesh::BlockMesh<3> slotted = mesh;
  Table<CellId, mesh::Cell> cells;
  Table<ElementId, mesh::BlockMesh<3>::Element> elements;
  const auto in_slot = [&](const auto& nodes, std::size_t count) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < count; ++i) middle += mesh.nodes[nodes[i]] / static_cast<double>(count);
    return std::abs(middle.x()) < 0.05 && middle.z() > -0.5;
  };
  for (const CellId cell : mesh.cells.ids()) {
    if (!in_slot(mesh.cells[cell].nodes, 8)) cells.push_back(mesh.cells[cell]);
  }
  const mesh::CellOfElement<3> cell_of(mesh);
  for (const ElementId element : mesh.elements.ids()) {
    if (!in_slot(mesh.cells[cell_of[element]].nodes, 8)) elements.push_back(mesh.elements[element]);
  }
  slotted.cells = cells;
  slotted.elements = elements;
  mesh::Block& block = slotted.blocks[BlockId{0}];
  block = {block.body, block.nodes, {0, elements.size()}, {0, cells.size()}};
  const Eigen::VectorXd field = at_nodes(slotted, [](const Eigen::Vector3d& at) { return at.x() < 0 ? 400.0 : 300.0; });
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(-0.1, 0, 0.72), Eigen::Vector3d(-0.07, 0.03, 0.8)}) {
    EXPECT_NEAR(value_at(locate_probes(slotted, {{"p", point}}, Reading::cubic)[0], field), 400, 1e-9);
    const Eigen::Vector3d beyond(-point.x(), point.y(), point.z());
    EXPECT_NEAR(value_at(locate_probes(slotted, {{"p", beyond}}, Reading::cubic)[0], field), 300, 1e-9);
  }
}

// A field that is odd along two edges of the cube: on one diagonal of its faces it is positive, on the other negative.
TEST(Probes, PreferNoDiagonalOfACell) {
  const auto mesh = grid({1, 1, 1}, 1);
  const Eigen::VectorXd field =
      at_nodes(mesh, [](const Eigen::Vector3d& at) { return at.x() * at.y() + at.y() * at.z() * at.x(); });
  const auto read = [&](const Eigen::Vector3d& at) { return value_at(locate_probes(mesh, {{"p", at}})[0], field); };
  EXPECT_NEAR(read({0, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(read({0, 0, 0.5}), 0, 1e-15) << "the middle of a face is the mean of its corners";
  for (const double x : {0.1, 0.3, 0.45}) {
    EXPECT_NEAR(read({x, 0.2, 0.5}), -read({-x, 0.2, 0.5}), 1e-15);
    EXPECT_NEAR(read({x, 0.2, 0.5}), read({0.2, x, 0.5}), 1e-15);
  }
}

TEST(Probes, TheBoundaryBelongsToTheBlock) {
  const auto mesh = two_tets();
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.3, 0.4, 0), Eigen::Vector3d(0.1, 0.2, 0.7),
                                       Eigen::Vector3d(1.0 / 3, 1.0 / 3, 1.0 / 3)}) {
    EXPECT_EQ(locate_probes(mesh, {{"p", point}})[0].block, BlockId{0}) << point.transpose();
  }
}

TEST(Probes, OfTwoBlocksThatOverlapTheFirstCounts) {
  auto mesh = two_tets();
  add_block<3>(mesh, BodyId{0}, unit_tet());
  EXPECT_EQ(locate_probes(mesh, {{"p", {0.2, 0.2, 0.2}}})[0].block, BlockId{0});
}

TEST(Probes, AVoidIsAnErrorThatNamesTheNearestBlockItsBodyAndTheWayOut) {
  ProbeSpec spec{"high", {1.5, 0, 0}};
  spec.point.x() = 1.75;
  spec.where = {"pile.yaml", 20, 5};
  EXPECT_EQ(message(two_tets(), spec),
            "pile.yaml:20:5: output.probes.high is [1.75, 0, 0] (must lie in a block; the nearest, block 1 of stone, is 0.25 m "
            "away). Move it, or let it move by itself with {point: [1.75, 0, 0], reach: 0.26 m}");
  spec.reach = 0.1;
  EXPECT_THAT(message(two_tets(), spec), HasSubstr("is 0.25 m away and its reach is 0.1 m"));
}

TEST(Probes, EveryVoidIsReportedAtOnce) {
  try {
    locate_probes(two_tets(), {{"a", {9, 0, 0}}, {"b", {0.1, 0.1, 0.1}}, {"c", {0, 9, 0}}});
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_EQ(error.problems()[1].key, "output.probes.c");
  }
}

TEST(Probes, WithoutBlocksThereIsNoNearestOne) {
  EXPECT_THAT(message({}, {"p", {0, 0, 0}}), HasSubstr("but there are none"));
}

TEST(Probes, TheSuggestedReachIsEnough) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 3);
  const auto mesh = two_tets();
  for (int i = 0; i < 200; ++i) {
    ProbeSpec spec{"p", {coordinate(random), coordinate(random), coordinate(random)}};
    const std::string text = message(mesh, spec);
    if (text == "no error") continue;
    spec.reach = std::stod(text.substr(text.find("reach: ") + 7));
    EXPECT_EQ(message(mesh, spec), "no error");
  }
}

TEST(Probes, AProbeWithinReachMovesToTheNearestPointOfTheBlocks) {
  // Brute force: no point of a fine lattice of weights is nearer.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 3);
  const auto mesh = two_tets();
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d point(coordinate(random), coordinate(random), coordinate(random));
    const auto probe = locate_probes(mesh, {{"p", point, 10}})[0];
    EXPECT_NEAR((probe.point - point).norm(), probe.moved, 1e-12);
    double nearest = 1e9;
    constexpr int n = 20;
    for (const double x : {0.0, 2.0}) {
      for (int a = 0; a <= n; ++a) {
        for (int b = 0; a + b <= n; ++b) {
          for (int c = 0; a + b + c <= n; ++c) {
            nearest = std::min(nearest, (Eigen::Vector3d(x + a / double(n), b / double(n), c / double(n)) - point).norm());
          }
        }
      }
    }
    EXPECT_LE(probe.moved, nearest + 1e-12);
    EXPECT_GE(probe.moved, nearest - 1.0 / n);
  }
}

TEST(Probes, TheDescriptionNamesBlockBodyAndPlace) {
  const auto mesh = two_tets();
  const auto probes = locate_probes(mesh, {{"low", {0.25, 0.25, 0.125}}, {"high", {2.25, 0.25, -0.5}, 1}});
  const Table<BlockId, BlockId> numbers({BlockId{4}, BlockId{7}});
  EXPECT_THAT(describe(probes, mesh, numbers), ElementsAre("low: block 4 of rock at [0.25, 0.25, 0.125] m",
                                                           "high: block 7 of stone at [2.25, 0.25, 0] m, moved by 0.5 m"));
}

}  // namespace
}  // namespace scree::output
