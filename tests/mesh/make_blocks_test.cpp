#include "engine/mesh/make_blocks.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "engine/base/threads.h"
#include "tests/mesh/body_builders.h"

namespace scree::mesh {
namespace {

using std::numbers::pi;

// Twice the outward area vector of a face; its sum over a closed surface is zero.
Eigen::Vector3d area_vector(const BlockMesh<3>& mesh, const Face<3>& face) {
  const auto& [a, b, c] = face.nodes;
  return (mesh.nodes[b] - mesh.nodes[a]).cross(mesh.nodes[c] - mesh.nodes[a]);
}

template <int dim>
double smallest_volume(const BlockMesh<dim>& mesh) {
  double smallest = 1e300;
  for (const ElementId e : mesh.elements.ids()) smallest = std::min(smallest, element_volume(mesh, e));
  return smallest;
}

// Mean ratio: 1 for a regular tetrahedron, 0 for a flat one.
double worst_mean_ratio(const BlockMesh<3>& mesh) {
  double worst = 1;
  for (const ElementId e : mesh.elements.ids()) {
    const auto& corner = mesh.elements[e];
    double squares = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) squares += (mesh.nodes[corner[i]] - mesh.nodes[corner[j]]).squaredNorm();
    }
    worst = std::min(worst, 12 * std::pow(3 * element_volume(mesh, e), 2.0 / 3) / squares);
  }
  return worst;
}

template <int dim>
bool same_to_the_bit(const BlockMesh<dim>& a, const BlockMesh<dim>& b) {
  return a.nodes == b.nodes && a.elements == b.elements;
}

TEST(MakeBlocks, ABoxHasItsVolumeAndItsSurface) {
  const auto mesh = make_blocks<3>({body_of(box_of(0.4, 0.3, 0.2), 0.08)});
  ASSERT_EQ(mesh.blocks.size(), 1u);
  EXPECT_NEAR(total_volume(mesh), 0.4 * 0.3 * 0.2, 1e-15);
  EXPECT_GT(smallest_volume(mesh), 0);
  Eigen::Vector3d closed = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto& face : boundary_faces(mesh)) {
    closed += area_vector(mesh, face);
    area += area_vector(mesh, face).norm() / 2;
  }
  EXPECT_LT(closed.norm(), 1e-15);
  EXPECT_NEAR(area, 2 * (0.4 * 0.3 + 0.3 * 0.2 + 0.2 * 0.4), 1e-14);
}

TEST(MakeBlocks, LeavesTheNumberOfThreadsAsItWas) {
  const int before = threads_in_use();
  use_threads(3);
  static_cast<void>(make_blocks<3>({body_of(box_of(0.4, 0.3, 0.2), 0.2)}));
  EXPECT_EQ(threads_in_use(), 3);
  use_threads(before);
}

TEST(MakeBlocks, TheFacesOfABoxAreFlatToTheBit) {
  const auto mesh = make_blocks<3>({body_of(box_of(0.37, 0.31, 0.23), 0.05)});
  for (const auto& face : boundary_faces(mesh)) {
    bool flat = false;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [a, b, c] = face.nodes;
      flat |= mesh.nodes[a][axis] == mesh.nodes[b][axis] && mesh.nodes[b][axis] == mesh.nodes[c][axis];
    }
    EXPECT_TRUE(flat);
  }
}

TEST(MakeBlocks, ARectangleHasItsArea) {
  const auto mesh = make_blocks<2>({body_of(box_of(2, 1, 0), 0.15)});
  EXPECT_NEAR(total_volume(mesh), 2, 1e-13);
  EXPECT_GT(smallest_volume(mesh), 0);
}

TEST(MakeBlocks, RoundShapesGainTheirVolumeWithTheSquareOfTheMeshSize) {
  const auto missing3 = [](const Shape& shape, double exact, double size) {
    const auto mesh = make_blocks<3>({body_of(shape, size)});
    EXPECT_GT(smallest_volume(mesh), 0);
    return 1 - total_volume(mesh) / exact;
  };
  const auto missing2 = [](double size) { return 1 - total_volume(make_blocks<2>({body_of(Sphere{2}, size)})) / pi; };
  const Shape sphere = Sphere{2}, cylinder = Cylinder{2, 3};
  EXPECT_NEAR(missing3(sphere, 4 * pi / 3, 0.4) / missing3(sphere, 4 * pi / 3, 0.2), 4, 0.8);
  EXPECT_NEAR(missing3(cylinder, 3 * pi, 0.4) / missing3(cylinder, 3 * pi, 0.2), 4, 0.8);
  EXPECT_NEAR(missing2(0.2) / missing2(0.1), 4, 0.2);
  EXPECT_LT(missing3(sphere, 4 * pi / 3, 0.2), 0.02);
}

TEST(MakeBlocks, TheNodesOfASphereAreInItAndItsFacesOnIt) {
  const auto mesh = make_blocks<3>({body_of(Sphere{0.4}, 0.06)});
  for (const auto& face : boundary_faces(mesh)) {
    for (const NodeId node : face.nodes) EXPECT_NEAR(mesh.nodes[node].norm(), 0.2, 1e-15);
  }
}

TEST(MakeBlocks, ElementsAreAboutAsLongAsAsked) {
  const auto mesh = make_blocks<3>({body_of(box_of(1, 1, 1), 0.1)});
  EXPECT_NEAR(mean_edge(mesh), 0.1, 0.035);
}

TEST(MakeBlocks, AMeshSizeBeyondTheShapeGivesAFewElements) {
  const auto box = make_blocks<3>({body_of(box_of(0.4, 0.4, 0.4), 5)});
  EXPECT_LE(box.elements.size(), 24u);
  EXPECT_NEAR(total_volume(box), 0.064, 1e-15);
  const auto sphere = make_blocks<3>({body_of(Sphere{0.4}, 5)});
  EXPECT_GT(worst_mean_ratio(sphere), 0.5);
  EXPECT_LE(sphere.elements.size(), 48u);
  EXPECT_GT(total_volume(sphere), 0.6 * 4.0 / 3 * pi * 0.008);
}

TEST(MakeBlocks, BlocksPerElementOwnTheirNodes) {
  const auto whole = make_blocks<3>({body_of(Sphere{0.4}, 0.1)});
  const auto apart = make_blocks<3>({body_of(Sphere{0.4}, 0.1, BlockRule::per_element)});
  EXPECT_EQ(apart.blocks.size(), whole.elements.size());
  EXPECT_EQ(apart.nodes.size(), 4 * whole.elements.size());
  for (const Block& block : apart.blocks) {
    EXPECT_EQ(block.elements.size(), 1u);
    EXPECT_EQ(block.nodes.size(), 4u);
  }
  for (const ElementId e : whole.elements.ids()) EXPECT_EQ(element_volume(whole, e), element_volume(apart, e));
}

TEST(MakeBlocks, NoSingleElementBlockIsASliver) {
  for (const Shape& shape : {Shape{Sphere{0.4}}, Shape{box_of(0.4, 0.4, 0.4)}}) {
    EXPECT_GT(worst_mean_ratio(make_blocks<3>({body_of(shape, 0.04, BlockRule::per_element)})), 0.5);
  }
}

TEST(MakeBlocks, AThinPlateHasNoSlivers) {
  EXPECT_GT(worst_mean_ratio(make_blocks<3>({body_of(box_of(0.4, 0.4, 0.05), 0.05)})), 0.3);
}

TEST(MakeBlocks, BlocksComeBodyByBodyAndCopyByCopy) {
  auto first = body_of(box_of(1, 1, 1), 5);
  first.arrangement = AtPoses{{Pose{{0, 0, 0}}, Pose{{3, 0, 0}}}};
  auto second = body_of(Sphere{1}, 5, BlockRule::per_element);
  second.fixed = true;
  const auto mesh = make_blocks<3>({first, second});
  ASSERT_EQ(mesh.bodies.size(), 2u);
  EXPECT_TRUE(mesh.bodies[BodyId{1}].fixed);
  std::size_t node = 0, element = 0;
  for (const BlockId b : mesh.blocks.ids()) {
    const Block& block = mesh.blocks[b];
    EXPECT_EQ(block.body.index(), b.index() < 2 ? 0u : 1u);
    EXPECT_EQ(block.nodes.first(), node);
    EXPECT_EQ(block.elements.first(), element);
    node = block.nodes.last();
    element = block.elements.last();
  }
  EXPECT_EQ(node, mesh.nodes.size());
  EXPECT_EQ(element, mesh.elements.size());
}

TEST(MakeBlocks, TheSameBodiesGiveTheSameMeshToTheBit) {
  const std::vector<BodySpec> bodies{body_of(Sphere{0.4}, 0.05), body_of(box_of(0.4, 0.4, 0.4), 0.06),
                                     body_of(Cylinder{0.4, 0.4}, 0.07)};
  EXPECT_TRUE(same_to_the_bit(make_blocks<3>(bodies), make_blocks<3>(bodies)));
}

TEST(MakeBlocks, ACopyIsTheShapeMovedByItsPose) {
  auto body = body_of(box_of(0.4, 0.3, 0.2), 0.1);
  const auto reference = make_blocks<3>({body});
  Pose pose;
  pose.translation = {1, 2, 3};
  pose.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized());
  body.arrangement = AtPoses{{pose}};
  const auto moved = make_blocks<3>({body});
  for (const NodeId n : reference.nodes.ids()) EXPECT_EQ(moved.nodes[n], pose * reference.nodes[n]);
  // Its principal axes turn with it.
  EXPECT_EQ(moved.blocks[BlockId{0}].orientation.coeffs(), pose.rotation.coeffs());
}

// OpenCASCADE takes 1e-7 m for nothing.
TEST(MakeBlocks, ThinFilmsAndGrainsOfDustAreMeshed) {
  const double film = 1e-8, wide = 1e-4, dust = 1e-7;
  EXPECT_NEAR(total_volume(make_blocks<3>({body_of(Cylinder{dust, film}, 1)})) / (pi / 4 * dust * dust * film), 0.9, 0.1);
  EXPECT_NEAR(total_volume(make_blocks<3>({body_of(Cylinder{wide, dust}, wide / 4)})) / (pi / 4 * wide * wide * dust), 0.97,
              0.03);
  EXPECT_NEAR(total_volume(make_blocks<3>({body_of(box_of(wide, wide, dust), wide)})) / (wide * wide * dust), 1, 1e-12);
  EXPECT_NEAR(total_volume(make_blocks<2>({body_of(box_of(wide, film, 0), wide)})) / (wide * film), 1, 1e-12);
}

TEST(MakeBlocks, ACylinderInTwoDimensionsIsRefused) {
  EXPECT_EQ(input_error([] {
              make_blocks<2>({body_of(Cylinder{1, 1}, 0.5)});
            }),
            "scene.yaml:4:10: bodies.stone.cylinder (a scene in 2-D has no cylinders). Use a box or a disc (sphere)");
}

TEST(MakeBlocks, ShapesThatAreFarTooSlenderAreRefused) {
  EXPECT_EQ(make_blocks<3>({body_of(box_of(0.1, 1e5, 0.1), 1e5)}).blocks.size(), 1u);
  const auto refusal = [](const Shape& shape) { return input_error([&] { make_blocks<3>({body_of(shape, 1e8)}); }); };
  EXPECT_THAT(refusal(box_of(0.1, 1e8, 0.1)), testing::HasSubstr("1e+06 times as long as thick"));
  EXPECT_THAT(refusal(Cylinder{1e9, 1}), testing::HasSubstr("1e+06 times as long as thick"));
  EXPECT_THAT(refusal(Cylinder{0.4, 1e5}), testing::HasSubstr("10000 times as long as thick"));
  EXPECT_THAT(input_error([] { make_blocks<2>({body_of(box_of(1, 1e12, 0), 1e12)}); }), testing::HasSubstr("as long as thick"));
}

TEST(MakeBlocks, ABodySoFarAwayThatItsCoordinatesAreRoundedIsRefused) {
  BodySpec body = body_of(box_of(1, 1, 1), 1);
  body.arrangement = AtPoses{{Pose{{3e7, 0, 0}, Eigen::Quaterniond::Identity()}}};
  EXPECT_EQ(make_blocks<3>({body}).blocks.size(), 1u);
  body.arrangement = AtPoses{{Pose{{1e16, 0, 0}, Eigen::Quaterniond::Identity()}}};
  EXPECT_THAT(input_error([&] { make_blocks<3>({body}); }), testing::HasSubstr("1e+16 m from the origin"));
}

TEST(MakeBlocks, AMeshSizeThatWouldFillTheMemoryIsRefused) {
  EXPECT_EQ(
      input_error([] { make_blocks<3>({body_of(box_of(1, 1, 1), 1e-4)}); }),
      "scene.yaml:4:10: bodies.stone.mesh_size is 0.0001 m (it would make about 8.3e+12 elements, and 2e+07 are the most). "
      "Choose a larger mesh_size");
}

}  // namespace
}  // namespace scree::mesh
