// Patch tests: a linear temperature over blocks whose meshes do not match.
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "tests/verification/steady.h"
#include "thermal/boundary.h"
#include "thermal/joint_conduction.h"

namespace scree::thermal {
namespace {

template <class Dim>
class Patch : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Patch, Dimensions);

JointOptions joint_of(const JointLaw& law, std::optional<contact::Model> model = {}) {
  JointOptions joint;
  joint.law = law;
  joint.model = model;
  return joint;
}

// Boxes beside and on each other, meshed 2, 3 and 5 cells across: an L of three interfaces of which none matches, meeting in a
// line. As blocks of one element each, they match inside the boxes.
template <int dim>
mesh::BlockMesh<dim> three_boxes(bool block_per_element) {
  std::vector<test::Slab<dim>> boxes(3);
  for (int i = 0; i < 3; ++i) {
    boxes[i].cells.fill(std::array{2, 3, 5}[i]);
    boxes[i].block_per_element = block_per_element;
  }
  boxes[1].low[0] = 1;
  boxes[2].low[dim - 1] = 1;
  boxes[2].size[0] = 2;
  return test::slab_mesh<dim>(boxes);
}

template <int dim>
double linear(const Point<dim>& point) {
  return 300 + 7 * point[0] - 5 * point[1] + 3 * point[dim - 1];
}

template <int dim>
test::Held held_around(const mesh::BlockMesh<dim>& mesh) {
  Point<dim> high = Point<dim>::Constant(1);
  high[0] = high[dim - 1] = 2;
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    const Point<dim>& point = mesh.nodes[node];
    if (((point.array() < 1e-9) || (point.array() > high.array() - 1e-9)).any()) held[node] = linear<dim>(point);
  }
  return held;
}

template <int dim>
double largest_error(const mesh::BlockMesh<dim>& mesh, const JointOptions& joint) {
  const auto contacts = contact::find_contacts(mesh, contact_search(joint, mesh.bodies, {}));
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint;
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contacts, options);
  const Eigen::VectorXd temperature = test::steady(model, held_around<dim>(mesh));
  double largest = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    largest = std::max(largest, std::abs(temperature[node.value()] - linear<dim>(mesh.nodes[node])));
  }
  return largest;
}

TYPED_TEST(Patch, PerfectJointsPassALinearFieldOverNonMatchingMeshes) {
  constexpr int dim = TypeParam::value;
  EXPECT_LT(largest_error<dim>(three_boxes<dim>(false), joint_of(PerfectJoint{})), 1e-10);
}

TYPED_TEST(Patch, PerfectJointsPassALinearFieldWhereManyBlocksMeetInPoints) {
  constexpr int dim = TypeParam::value;
  EXPECT_LT(largest_error<dim>(three_boxes<dim>(true), joint_of(PerfectJoint{})), 1e-10);
}

// A joint that resists cannot pass a field without a jump; with a conductance the error falls as 1/h, whatever the mesh.
TYPED_TEST(Patch, OverlapsOfAConductanceConvergeToTheLinearField) {
  constexpr int dim = TypeParam::value;
  const auto mesh = three_boxes<dim>(false);
  const double error6 = largest_error<dim>(mesh, joint_of(JointConductance{1e6}));
  EXPECT_NEAR(error6 / largest_error<dim>(mesh, joint_of(JointConductance{1e7})), 10, 1);
}

// Semi-springs hold the two sides together in their points, which a linear field allows: what is left is their resistance.
TYPED_TEST(Patch, SemiSpringsComeToTheLinearFieldAsBetaGrowsAndLiteralOnesDoNot) {
  constexpr int dim = TypeParam::value;
  const auto mesh = three_boxes<dim>(false);
  for (const JointForm form : {JointForm::consistent, JointForm::literal}) {
    const auto error = [&](double beta) {
      JointOptions joint = joint_of(StiffnessFactor{beta});
      joint.form = form;
      return largest_error<dim>(mesh, joint);
    };
    if (form == JointForm::consistent) {
      EXPECT_GT(error(10), 0.1);
      EXPECT_NEAR(error(1e4) / error(1e5), 10, 1.5);
    } else {
      EXPECT_GT(error(1e5), 0.02);
    }
  }
}

// Two conductivities a thousandfold apart, seen across the joint: flux and temperature are continuous.
TYPED_TEST(Patch, PerfectJointsPassAFluxBetweenUnlikeMaterials) {
  constexpr int dim = TypeParam::value;
  std::vector<test::Slab<dim>> boxes(2);
  boxes[0].cells.fill(2);
  boxes[1].cells.fill(3);
  boxes[1].low[0] = 1;
  boxes[1].material = MaterialId{1};
  const auto mesh = test::slab_mesh<dim>(boxes);
  Table<MaterialId, Material> materials = test::rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = 4000;
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint_of(PerfectJoint{});
  const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
  const HeatModel model = make_heat_model(mesh, materials, contacts, options);
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node][0] < 1e-9) held[node] = 400;
    if (mesh.nodes[node][0] > 2 - 1e-9) held[node] = 300;
  }
  const Eigen::VectorXd temperature = test::steady(model, held);
  const double flux = 100 / (1 / 4.0 + 1 / 4000.0);
  for (const NodeId node : mesh.nodes.ids()) {
    const double x = mesh.nodes[node][0];
    const double expected = model.blocks[node] == BlockId{0} ? 400 - flux * x / 4 : 300 + flux * (2 - x) / 4000;
    EXPECT_NEAR(temperature[node.value()], expected, 1e-9);
  }
  double flow = 0;
  for (const double part : contact_flows(contacts, joint_conduction(mesh, materials, contacts, options.joint), temperature,
                                         JointForm::consistent)) {
    flow += part;
  }
  EXPECT_NEAR(flow / flux, 1, 1e-10);
}

TYPED_TEST(Patch, PerfectJointsAreSymmetricPositiveSemidefiniteWithTheConstantsAsKernel) {
  constexpr int dim = TypeParam::value;
  auto mesh = three_boxes<dim>(true);
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint_of(PerfectJoint{});
  const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
  mesh.bodies[BodyId{1}].material = MaterialId{1};
  Table<MaterialId, Material> materials = test::rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = 400;
  const HeatModel model = make_heat_model(mesh, materials, contacts, options);
  const SparseMatrix transposed = model.conductance.transpose();
  EXPECT_EQ((model.conductance - transposed).norm(), 0);
  const double scale = model.conductance.coeffs().abs().maxCoeff();
  const Eigen::VectorXd sums = model.conductance * Eigen::VectorXd::Ones(model.conductance.cols());
  EXPECT_LT(sums.cwiseAbs().maxCoeff(), 1e-13 * scale);
  // With one node held K must be definite: steady() refuses it otherwise.
  EXPECT_NO_THROW((void)test::steady(model.conductance, {{NodeId{0}, 1.0}}));
  if constexpr (dim == 2) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(model.conductance), Eigen::EigenvaluesOnly);
    EXPECT_NEAR(eigen.eigenvalues()[0], 0, 1e-12 * scale);
    EXPECT_GT(eigen.eigenvalues()[1], 1e-5 * scale);
  }
}

// Heat that a joint's contacts carry is what they take from one block and give to the other.
TYPED_TEST(Patch, FlowsOfPerfectJointsAreWhatTheyAddToTheBalance) {
  constexpr int dim = TypeParam::value;
  const auto mesh = three_boxes<dim>(false);
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint_of(PerfectJoint{});
  const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
  const HeatModel with = make_heat_model(mesh, test::rock_only(), contacts, options);
  const HeatModel without = make_heat_model(mesh, test::rock_only(), {}, options);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(300, 400);
  const Eigen::VectorXd temperature = Eigen::VectorXd::NullaryExpr(with.initial.size(), [&]() { return unit(random); });
  const Eigen::VectorXd lost = (with.conductance - without.conductance) * temperature;
  std::vector<double> by_block(mesh.blocks.size(), 0);
  const auto flows = contact_flows(contacts, joint_conduction(mesh, test::rock_only(), contacts, options.joint), temperature,
                                   JointForm::consistent);
  for (std::size_t c = 0; c < flows.size(); ++c) {
    by_block[contacts.contacts[c].owner.index()] += flows[c];
    by_block[contacts.contacts[c].target.index()] -= flows[c];
  }
  for (const BlockId block : mesh.blocks.ids()) {
    double sum = 0;
    for (const NodeId node : mesh.blocks[block].nodes) sum += lost[node.value()];
    EXPECT_NEAR(sum, by_block[block.index()], 1e-8);
  }
}

// Two boxes beside each other that do not match, of unlike conductivities; the far end of the second is held at 300 K.
template <int dim>
struct DrivenJoint {
  mesh::BlockMesh<dim> mesh;
  Table<MaterialId, Material> materials = test::rock_only();
  HeatOptions options;

  explicit DrivenJoint(double conductivity) {
    std::vector<test::Slab<dim>> boxes(2);
    boxes[0].cells.fill(2);
    boxes[1].cells.fill(3);
    boxes[1].low[0] = 1;
    boxes[1].material = MaterialId{1};
    mesh = test::slab_mesh<dim>(boxes);
    materials.push_back(test::rock());
    materials[MaterialId{0}].conductivity = conductivity;
    options = test::options_for(mesh, 300);
    options.joint = joint_of(PerfectJoint{});
    options.boundaries.push_back(test::hold(BodyId{1}, 2, 300, "end"));
  }

  // In the first box 400 K everywhere, in the second a straight line from it, and 400 W through the joint.
  void expect_the_flow_of_the_second_alone(const test::Held& held, const std::map<NodeId, double>& load) {
    const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
    const HeatModel model = make_heat_model(mesh, materials, contacts, options);
    const Eigen::VectorXd temperature = test::steady(model, held, load);
    for (const NodeId node : mesh.nodes.ids()) {
      const double expected = model.blocks[node] == BlockId{0} ? 400 : 400 - 100 * (mesh.nodes[node][0] - 1);
      EXPECT_NEAR(temperature[node.value()], expected, 1e-9);
    }
    const JointConduction joints = joint_conduction(mesh, materials, contacts, options.joint, driven_nodes(mesh, options));
    double flow = 0;
    for (const double part : contact_flows(contacts, joints, temperature, JointForm::consistent)) flow += part;
    EXPECT_NEAR(flow, 400, 1e-8);
  }

  [[nodiscard]] test::Held end() const {
    test::Held held;
    for (const NodeId node : mesh.nodes.ids()) {
      if (mesh.nodes[node][0] > 2 - 1e-9) held[node] = 300;
    }
    return held;
  }
};

TYPED_TEST(Patch, PerfectJointsAreExactWhereOneSideIsHeld) {
  for (const double conductivity : {0.04, 4.0, 400.0}) {
    DrivenJoint<TypeParam::value> driven(conductivity);
    driven.options.boundaries.push_back(test::hold(BodyId{0}, 1, 400, "joint"));
    test::Held held = driven.end();
    for (const NodeId node : driven.mesh.blocks[BlockId{0}].nodes) {
      if (driven.mesh.nodes[node][0] > 1 - 1e-9) held[node] = 400;
    }
    driven.expect_the_flow_of_the_second_alone(held, {});
  }
}

TYPED_TEST(Patch, PerfectJointsAreExactWhereOneSideIsHeatedFromOutside) {
  for (const double conductivity : {0.04, 4.0, 400.0}) {
    DrivenJoint<TypeParam::value> driven(conductivity);
    Boundary heated = test::hold(BodyId{0}, 1, 0, "joint");
    heated.condition = HeatFlux{400};
    driven.options.boundaries.push_back(heated);
    const HeatModel model = make_heat_model(driven.mesh, driven.materials, {}, driven.options);
    std::map<NodeId, double> load;
    for (std::size_t i = 0; i < model.loads[0].on.nodes.size(); ++i) {
      load[model.loads[0].on.nodes[i]] += 400 * model.loads[0].on.shares[i];
    }
    driven.expect_the_flow_of_the_second_alone(driven.end(), load);
  }
}

}  // namespace
}  // namespace scree::thermal
