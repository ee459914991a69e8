// The non-aligned grid of Li & Feng (2016), section 2.3: 2 m x 2 m in four blocks with meshes of 0.3, 0.2, 0.1 and 0.05 m, the
// outer boundary at 0 C and one node of B near the centre at 100 C.
//
// A node that is held is a point source whose flow depends on the mesh around it. So the conforming mesh of 0.02 m gets the
// same flow in the same place, and the fields are compared beyond 0.3 m from it.
#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "contact/find_contacts.h"
#include "engine/mesh/make_blocks.h"
#include "tests/thermal/builders.h"
#include "tests/verification/steady.h"

namespace scree::thermal {
namespace {

mesh::BodySpec square(const std::string& name, const Eigen::Vector3d& centre, double side, double mesh_size) {
  mesh::BodySpec body;
  body.name = name;
  body.shape = mesh::Box{{side, side, 0}};
  mesh::AtPoses at;
  at.poses.front().translation = centre;
  body.arrangement = at;
  body.mesh_size = mesh_size;
  body.material = MaterialId{0};
  return body;
}

mesh::BlockMesh<2> four_blocks() {
  return mesh::make_blocks<2>({square("A", {-0.5, 0.5, 0}, 1, 0.3), square("B", {0.5, 0.5, 0}, 1, 0.2),
                               square("C", {-0.5, -0.5, 0}, 1, 0.1), square("D", {0.5, -0.5, 0}, 1, 0.05)});
}

test::Held cold_rim(const mesh::BlockMesh<2>& mesh) {
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node].cwiseAbs().maxCoeff() > 1 - 1e-9) held[node] = 0;
  }
  return held;
}

// The inner node of B that is closest to the centre.
NodeId source_of(const mesh::BlockMesh<2>& mesh) {
  NodeId best;
  for (const NodeId node : mesh.blocks[BlockId{1}].nodes) {
    const Point<2>& place = mesh.nodes[node];
    if (place.minCoeff() < 1e-9) continue;
    if (!best.valid() || place.norm() < mesh.nodes[best].norm()) best = node;
  }
  return best;
}

HeatModel model_of(const mesh::BlockMesh<2>& mesh, const JointOptions& joint) {
  Material material = test::rock();
  material.conductivity = 4.2;
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint;
  const auto contacts = contact::find_contacts(mesh, contact_search(joint, mesh.bodies, {}));
  return make_heat_model(mesh, Table<MaterialId, Material>({material}), contacts, options);
}

// The element that holds a point, and the weights of its corners there.
struct Place {
  ElementId element;
  Eigen::Vector3d weights;
};

Place locate(const mesh::BlockMesh<2>& mesh, const Point<2>& point) {
  Place best;
  double least = -1;
  for (const ElementId element : mesh.elements.ids()) {
    Eigen::Matrix3d corners = Eigen::Matrix3d::Ones();
    for (int i = 0; i < 3; ++i) corners.col(i).head<2>() = mesh.nodes[mesh.elements[element][i]];
    const Eigen::Vector3d weights = corners.inverse() * Eigen::Vector3d(point.x(), point.y(), 1);
    if (weights.minCoeff() > least) {
      least = weights.minCoeff();
      best = {element, weights};
    }
    if (least >= 0) break;
  }
  return best;
}

struct Comparison {
  double largest = 0;  // difference beyond 0.3 m from the source [K]
  double hottest = 0;  // there [C]
};

Comparison compare(const JointOptions& joint) {
  const auto mesh = four_blocks();
  const HeatModel model = model_of(mesh, joint);
  const NodeId source = source_of(mesh);
  test::Held held = cold_rim(mesh);
  held[source] = 100;
  const Eigen::VectorXd temperature = test::steady(model.conductance, held);
  const double flow = (model.conductance * temperature)[source.value()];

  static const auto fine = mesh::make_blocks<2>({square("whole", {0, 0, 0}, 2, 0.02)});
  static const HeatModel fine_model = model_of(fine, {});
  const Place at = locate(fine, mesh.nodes[source]);
  std::map<NodeId, double> load;
  for (int i = 0; i < 3; ++i) load[fine.elements[at.element][i]] = flow * at.weights[i];
  const Eigen::VectorXd expected = test::steady(fine_model.conductance, cold_rim(fine), load);

  Comparison comparison;
  for (const NodeId node : mesh.nodes.ids()) {
    if ((mesh.nodes[node] - mesh.nodes[source]).norm() < 0.3) continue;
    const Place place = locate(fine, mesh.nodes[node]);
    double value = 0;
    for (int i = 0; i < 3; ++i) value += place.weights[i] * expected[fine.elements[place.element][i].value()];
    comparison.largest = std::max(comparison.largest, std::abs(value - temperature[node.value()]));
    comparison.hottest = std::max(comparison.hottest, value);
  }
  return comparison;
}

JointOptions joint_of(const JointLaw& law, contact::Model model) {
  JointOptions joint;
  joint.law = law;
  joint.model = model;
  return joint;
}

TEST(NonAlignedGrid, TiedTogetherIsTheConformingMeshWithinAKelvin) {
  const Comparison perfect = compare(joint_of(PerfectJoint{}, contact::Model::overlap));
  EXPECT_GT(perfect.hottest, 30);
  EXPECT_LT(perfect.largest, 1.05);
}

// The paper's beta.
TEST(NonAlignedGrid, WithJointsOfBetaTenIsWithinAKelvinByEitherModel) {
  EXPECT_LT(compare(joint_of(StiffnessFactor{10}, contact::Model::semi_spring)).largest, 1);
  EXPECT_LT(compare(joint_of(StiffnessFactor{10}, contact::Model::overlap)).largest, 1);
}

// Where meshes do not match, a stiff joint makes the fine side follow the coarse one's straight lines: more beta is no nearer
// to no joint at all. A perfect joint does not lock.
TEST(NonAlignedGrid, OfStiffJointsLocksWhereAPerfectOneDoesNot) {
  const double perfect = compare(joint_of(PerfectJoint{}, contact::Model::overlap)).largest;
  EXPECT_GT(compare(joint_of(StiffnessFactor{1000}, contact::Model::semi_spring)).largest, 3 * perfect);
  EXPECT_GT(compare(joint_of(StiffnessFactor{1000}, contact::Model::overlap)).largest, 3 * perfect);
}

}  // namespace
}  // namespace scree::thermal
