// Joints between blocks of quadrilaterals, wedges and hexahedra, whose faces are seen through both diagonals.
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "contact/find_contacts.h"
#include "engine/mesh/cells.h"
#include "tests/mesh/cell_boxes.h"
#include "tests/thermal/builders.h"
#include "tests/verification/steady.h"

namespace scree::thermal {
namespace {

using Kind = std::optional<mesh::CellKind>;

const std::vector<Kind> solids{mesh::CellKind::hexahedron, mesh::CellKind::wedge, std::nullopt};

std::string name_of(const Kind& kind) {
  return kind ? mesh::kind_name(*kind) : "simplex";
}

// One unit box on the other.
mesh::BlockMesh<3> two_boxes(const Kind& lower, double lower_size, const Kind& upper, double upper_size, double turn = 0) {
  return mesh::test::cell_boxes<3>({{.centre = {0, 0, -0.5}, .mesh_size = lower_size, .kind = lower},
                                    {.centre = {0, 0, 0.5}, .mesh_size = upper_size, .kind = upper, .turn = turn}});
}

template <int dim>
HeatModel model_of(const mesh::BlockMesh<dim>& mesh, const JointOptions& joint) {
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint;
  return make_heat_model(mesh, test::rock_only(), contact::find_contacts(mesh, contact_search(joint, mesh.bodies, {})),
                         options);
}

JointOptions joint_of(const JointLaw& law, contact::Model model) {
  JointOptions joint;
  joint.law = law;
  joint.model = model;
  return joint;
}

const JointOptions perfect = joint_of(PerfectJoint{}, contact::Model::overlap);

// The lower side held at 400 K, the upper one at 300 K: the largest deviation from resistances in series.
double error_in_series(const mesh::BlockMesh<3>& mesh, const JointOptions& joint, double conductance) {
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    const double z = mesh.nodes[node].z();
    if (std::abs(z) > 1 - 1e-9) held[node] = z < 0 ? 400 : 300;
  }
  const HeatModel model = model_of(mesh, joint);
  const Eigen::VectorXd temperature = test::steady(model, held);
  const double flux = 100 / (2 / 4.0 + 1 / conductance);
  double largest = 0;
  for (const BlockId block : mesh.blocks.ids()) {
    for (const NodeId node : mesh.blocks[block].nodes) {
      const double z = mesh.nodes[node].z();
      const double exact = block.index() == 0 ? 400 - flux * (z + 1) / 4 : 300 + flux * (1 - z) / 4;
      largest = std::max(largest, std::abs(temperature[node.value()] - exact));
    }
  }
  return largest;
}

TEST(JointsOfCells, ByOverlapsCarryTheFlowOfResistancesInSeriesEvenly) {
  const JointOptions joint = joint_of(JointConductance{20}, contact::Model::overlap);
  for (const Kind& lower : solids) {
    for (const Kind& upper : solids) {
      for (const double size : {1.0, 0.5, 0.34}) {
        auto mesh = two_boxes(lower, 0.5, upper, size);
        mesh::test::bend_sideways(mesh);
        EXPECT_LT(error_in_series(mesh, joint, 20), 1e-9) << name_of(lower) << " " << name_of(upper) << " " << size;
      }
    }
  }
}

// Each semi-spring is a twentieth of the way from its corner to the middle of a triangle, not of the face. A diagonal seen
// alone left 12 K between corners.
TEST(JointsOfCells, BySemiSpringsCarryItNearlySo) {
  const JointOptions joint = joint_of(JointConductance{20}, contact::Model::semi_spring);
  for (const double size : {1.0, 0.5, 0.25}) {
    const auto mesh = two_boxes(mesh::CellKind::hexahedron, size, mesh::CellKind::hexahedron, size);
    EXPECT_LT(error_in_series(mesh, joint, 20), 0.3) << size;
  }
}

TEST(JointsOfCells, PassALinearFieldIfTheyArePerfect) {
  const auto linear = [](const Point<3>& point) { return 300 + 7 * point.x() - 5 * point.y() + 3 * point.z(); };
  for (const Kind& lower : solids) {
    for (const Kind& upper : solids) {
      auto mesh = two_boxes(lower, 0.5, upper, 0.34);
      test::Held held;
      for (const NodeId node : mesh.nodes.ids()) {
        const Point<3>& at = mesh.nodes[node];
        if (std::abs(at.z()) > 1 - 1e-9 || at.head<2>().cwiseAbs().maxCoeff() > 0.5 - 1e-9) held[node] = 0;
      }
      mesh::test::bend_sideways(mesh);
      for (auto& [node, temperature] : held) temperature = linear(mesh.nodes[node]);
      ASSERT_LT(held.size(), mesh.nodes.size());
      const Eigen::VectorXd temperature = test::steady(model_of(mesh, perfect), held);
      for (const NodeId node : mesh.nodes.ids()) {
        EXPECT_NEAR(temperature[node.value()], linear(mesh.nodes[node]), 1e-9) << name_of(lower) << " " << name_of(upper);
      }
    }
  }
}

TEST(JointsOfCells, PassALinearFieldInThePlane) {
  const auto linear = [](const Point<2>& point) { return 300 + 7 * point.x() - 5 * point.y(); };
  const auto mesh =
      mesh::test::cell_boxes<2>({{.centre = {0, -0.5, 0}, .mesh_size = 0.5, .kind = mesh::CellKind::quadrilateral},
                                 {.centre = {0, 0.5, 0}, .mesh_size = 0.34, .kind = mesh::CellKind::quadrilateral}});
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    const Point<2>& at = mesh.nodes[node];
    if (std::abs(at.y()) > 1 - 1e-9 || std::abs(at.x()) > 0.5 - 1e-9) held[node] = linear(at);
  }
  const Eigen::VectorXd temperature = test::steady(model_of(mesh, perfect), held);
  for (const NodeId node : mesh.nodes.ids()) EXPECT_NEAR(temperature[node.value()], linear(mesh.nodes[node]), 1e-10);
}

void expect_kernel_of_constants(const HeatModel& model, const std::string& name) {
  const double scale = model.conductance.coeffs().abs().maxCoeff();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(model.conductance), Eigen::EigenvaluesOnly);
  EXPECT_NEAR(eigen.eigenvalues()[0], 0, 1e-13 * scale) << name;
  EXPECT_GT(eigen.eigenvalues()[1], 1e-3 * scale) << name;
}

TEST(JointsOfCells, ArePositiveSemidefiniteIfTheyArePerfect) {
  for (const Kind& lower : solids) {
    for (const Kind& upper : solids) {
      auto mesh = two_boxes(lower, 1.0, upper, 0.34, 0.3);
      mesh::test::bend_sideways(mesh);
      expect_kernel_of_constants(model_of(mesh, perfect), name_of(lower) + " " + name_of(upper));
    }
  }
  expect_kernel_of_constants(
      model_of(mesh::test::cell_boxes<2>({{.centre = {0, -0.5, 0}, .kind = mesh::CellKind::quadrilateral},
                                          {.centre = {0.1, 0.5, 0}, .mesh_size = 0.34, .kind = mesh::CellKind::quadrilateral}}),
               perfect),
      "quadrilateral");
}

// The conductance of eq. (11) goes by the edges of the cell, however it is split: two cubes of 1 m, each side's semi-springs
// beta k/dL times the face.
TEST(JointsOfCells, OfAStiffnessFactorGoByTheEdgesOfTheCell) {
  for (const mesh::CellKind kind : {mesh::CellKind::hexahedron, mesh::CellKind::wedge}) {
    const auto mesh = two_boxes(kind, 1.0, kind, 1.0);
    const JointOptions joint = joint_of(StiffnessFactor{10}, contact::Model::semi_spring);
    const auto contacts = contact::find_contacts(mesh, contact_search(joint, mesh.bodies, {}));
    double sum = 0;
    for (const double g : joint_conduction(mesh, test::rock_only(), contacts, joint).conductances) sum += g;
    if (kind == mesh::CellKind::hexahedron) {
      EXPECT_NEAR(sum, 2 * 10 * 4, 1e-10);
    } else {
      double expected = 0;
      for (const contact::Contact<3>& contact : contacts.contacts) {
        const double edges = mesh::CharacteristicLength<3>(mesh).of(contact.owner_element);
        expected += 10 * 4 * contact.area / edges;
        EXPECT_LT(edges, 1.2);
      }
      EXPECT_NEAR(sum, expected, 1e-10);
    }
  }
}

// Two cubes whose common corners lie anywhere, as long as every simplex has volume: the faces are twisted, some so much that
// they are not convex from any side.
std::optional<mesh::BlockMesh<3>> twisted(std::mt19937& random) {
  auto mesh = two_boxes(mesh::CellKind::hexahedron, 1.0, mesh::CellKind::hexahedron, 1.0);
  std::normal_distribution<double> normal(0, 0.35);
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node].z() != 0) continue;
    const Point<3> shift = Point<3>::NullaryExpr([&](Eigen::Index) { return normal(random); });
    for (const NodeId other : mesh.nodes.ids()) {
      if (other.value() > node.value() && mesh.nodes[other] == mesh.nodes[node]) mesh.nodes[other] += shift;
    }
    mesh.nodes[node] += shift;
  }
  for (const ElementId element : mesh.elements.ids()) {
    if (mesh::element_volume(mesh, element) < 1e-3) return std::nullopt;
  }
  for (const CellId cell : mesh.cells.ids()) {
    for (const auto& simplex : mesh::both_splits(mesh, cell)) {
      if (mesh::simplex_volume(mesh, simplex) < 1e-3) return std::nullopt;
    }
  }
  return mesh;
}

std::set<NodeId> nodes_of_joint(const mesh::BlockMesh<3>& mesh) {
  const auto& lower = mesh.cells[CellId{0}].nodes;
  const auto& upper = mesh.cells[CellId{1}].nodes;
  std::set<NodeId> nodes(lower.begin() + 4, lower.end());
  nodes.insert(upper.begin(), upper.begin() + 4);
  return nodes;
}

// By the diagonals of the joint's face.
std::array<double, 2> areas_of_joint(const mesh::BlockMesh<3>& mesh) {
  const auto at = [&](std::size_t i) { return mesh.nodes[mesh.cells[CellId{0}].nodes[4 + i]]; };
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    return 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
  };
  return {triangle(0, 1, 2) + triangle(0, 2, 3), triangle(1, 2, 3) + triangle(1, 3, 0)};
}

TEST(JointsOfCells, HaveTheAreaOfATwistedFaceAndStaySoundThere) {
  std::mt19937 random(7);
  int convex = 0, dented = 0;
  for (int trial = 0; trial < 20000 && dented < 3; ++trial) {
    const auto mesh = twisted(random);
    if (!mesh) continue;
    const JointOptions joint = joint_of(JointConductance{20}, contact::Model::semi_spring);
    const std::set<NodeId> on_joint = nodes_of_joint(*mesh);
    double area = 0;
    bool both = true;
    const auto contacts = contact::find_contacts(*mesh, contact_search(joint, mesh->bodies, {}));
    for (const auto& contact : contacts.contacts) {
      EXPECT_GT(contact.area, 0);
      const auto& face = contact.on_owner.nodes;
      const bool of_joint = std::all_of(face.begin(), face.end(), [&](NodeId node) { return on_joint.contains(node); });
      if (contact.kind != contact::Kind::point_face || !of_joint) continue;  // other faces may lean over it
      area += contact.area / 2;
      both = both && contact.on_owner.fourth.valid();
    }
    const auto [one, other] = areas_of_joint(*mesh);
    if (both) {
      EXPECT_NEAR(area, 0.5 * (one + other), 1e-12);
    } else {
      EXPECT_LT(std::min(std::abs(area - one), std::abs(area - other)), 1e-12);
    }
    ++(both ? convex : dented);
    if (both && convex > 5) continue;
    expect_kernel_of_constants(model_of(*mesh, perfect), std::to_string(trial));
  }
  EXPECT_EQ(dented, 3);
  EXPECT_GT(convex, 5);
}

// A quarter turn: the diagonals by which the search sees the two sides cross.
TEST(JointsOfCells, AreTiedWhereQuadrilateralsMatchWhateverTheirDiagonals) {
  for (const double turn : {0.0, M_PI / 2}) {
    const auto mesh = two_boxes(mesh::CellKind::hexahedron, 1.0, mesh::CellKind::hexahedron, 1.0, turn);
    EXPECT_EQ(model_of(mesh, perfect).tied_nodes, 4) << turn;
    EXPECT_LT(error_in_series(mesh, perfect, 1e300), 1e-10) << turn;
  }
}

// Tied, they would share out even heat differently: the two triangles give a third of it to either end of their diagonal.
TEST(JointsOfCells, AreNotTiedWhereAQuadrilateralMeetsTwoTetrahedra) {
  auto mesh = two_boxes(mesh::CellKind::hexahedron, 1.0, mesh::CellKind::hexahedron, 1.0);
  mesh.blocks[BlockId{1}].cells = {};
  EXPECT_EQ(model_of(mesh, perfect).tied_nodes, 0);
  EXPECT_LT(error_in_series(mesh, perfect, 1e300), 1e-10);
}

}  // namespace
}  // namespace scree::thermal
