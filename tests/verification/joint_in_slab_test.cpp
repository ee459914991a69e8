// Two slabs of different materials with a joint between them, their far ends held: resistances in series.
#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/joint_report.h"

namespace scree::thermal {
namespace {

template <class Dim>
class JointInSlab : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(JointInSlab, Dimensions);

template <int dim>
mesh::BlockMesh<dim> two_slabs() {
  auto right = test::bar<dim>(0.2, 4, 2, 0.1);
  right.low[0] = 0.1;
  right.material = MaterialId{1};
  return test::slab_mesh<dim>({test::bar<dim>(0.1, 2, 2, 0.1), right});
}

Table<MaterialId, Material> two_materials() {
  Table<MaterialId, Material> materials = test::rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = 10;
  return materials;
}

struct Steady {
  double flow = 0;                               // through the hot end [W]
  double series = 0;                             // by resistances in series [W]
  double left_of_joint = 0, right_of_joint = 0;  // [K]
  std::vector<JointReport> joints;
};

template <int dim>
Steady steady(const contact::ContactSet<dim>& contacts, double beta) {
  const auto mesh = two_slabs<dim>();
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{beta};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "hot end"));
  options.boundaries.push_back(test::hold(BodyId{1}, 0.3, 300, "cold end"));
  const HeatModel model = make_heat_model(mesh, two_materials(), contacts, options);
  TimeOptions times;
  times.until = 1e9;
  HeatRun run(model, times);
  run.advance_to(1e9);
  const Eigen::VectorXd& temperature = run.state().temperature;
  const auto conduction = joint_conduction(mesh, two_materials(), contacts, options.joint);
  double joint = 0;
  for (const double g : conduction.conductances) joint += g;
  Steady result;
  const double side = dim == 2 ? 0.1 : 0.01;
  result.series = 100 / (0.1 / (4 * side) + 1 / joint + 0.2 / (10 * side));
  const Eigen::VectorXd leaving = model.conductance * temperature;
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node][0] < 1e-9) result.flow += leaving[node.value()];
    if (std::abs(mesh.nodes[node][0] - 0.1) > 1e-9) continue;
    (model.blocks[node] == BlockId{0} ? result.left_of_joint : result.right_of_joint) = temperature[node.value()];
  }
  const auto flows = contact_flows(contacts, conduction, temperature, options.joint.form);
  result.joints = joint_reports(mesh, two_materials(), contacts, options.joint, flows);
  return result;
}

TYPED_TEST(JointInSlab, FlowAndJumpAreThoseOfResistancesInSeries) {
  constexpr int dim = TypeParam::value;
  const double side = dim == 2 ? 0.1 : 0.01;
  for (const double beta : {0.01, 1.0, 1e3}) {
    const Steady found = steady<dim>(test::matching_contacts(two_slabs<dim>()), beta);
    EXPECT_NEAR(found.flow / found.series, 1, 1e-8) << beta;
    EXPECT_NEAR(found.left_of_joint, 400 - found.series * 0.1 / (4 * side), 1e-6) << beta;
    EXPECT_NEAR(found.right_of_joint, 300 + found.series * 0.2 / (10 * side), 1e-6) << beta;
  }
}

// The contact room's own search; semi-edges spread their share over the face a little differently than semi-springs.
TYPED_TEST(JointInSlab, FoundContactsConductTheSame) {
  constexpr int dim = TypeParam::value;
  const auto contacts = contact::find_contacts<dim>(two_slabs<dim>(), {});
  ASSERT_FALSE(contacts.contacts.empty());
  for (const double beta : {0.01, 1.0, 1e3}) {
    const Steady found = steady<dim>(contacts, beta);
    EXPECT_NEAR(found.flow / found.series, 1, dim == 2 ? 1e-8 : 0.01) << beta;
  }
}

TYPED_TEST(JointInSlab, TheReportStatesTheJointAsAConductance) {
  constexpr int dim = TypeParam::value;
  const Steady found = steady<dim>(test::matching_contacts(two_slabs<dim>()), 2.0);
  ASSERT_EQ(found.joints.size(), 1U);
  const JointReport& joint = found.joints.front();
  const double side = dim == 2 ? 0.1 : 0.01;
  EXPECT_EQ(joint.first, BodyId{0});
  EXPECT_EQ(joint.second, BodyId{1});
  EXPECT_EQ(joint.point_face, dim == 2 ? 2U * 2 * 2 : 2U * 8 * 3);
  EXPECT_NEAR(joint.touching_area, side, 1e-14);
  EXPECT_NEAR(joint.flow / found.series, 1, 1e-8);
  EXPECT_NEAR(joint.flow / (found.left_of_joint - found.right_of_joint) / side / joint.joint_conductance, 1, 1e-8);
  // Mean edges of the right-angled elements: equal on both sides, so all contacts conduct alike, and the faces' two sides add
  // up.
  EXPECT_NEAR(joint.least_conductance / joint.largest_conductance, 1, 1e-12);
  EXPECT_NEAR(joint.joint_conductance / joint.mean_conductance, 2, 1e-12);
}

}  // namespace
}  // namespace scree::thermal
