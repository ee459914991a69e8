// Joints from almost open to almost none, and blocks that touch nothing.
#include <cmath>

#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/joint_conduction.h"
#include "thermal/steady_state.h"

namespace scree::thermal {
namespace {

mesh::BlockMesh<2> rubble() {
  auto slab = test::bar<2>(0.1, 5, 2, 0.04);
  slab.block_per_element = true;
  return test::slab_mesh<2>({slab});
}

TimeOptions until(double time) {
  TimeOptions options;
  options.until = time;
  return options;
}

class StiffJoints : public testing::TestWithParam<double> {};

TEST_P(StiffJoints, KeepTheirHeatAndTheTolerance) {
  const auto mesh = rubble();
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{GetParam()};
  options.sources.push_back({test::on(BodyId{0}, test::between_x(0, 0.02)), 1e5, "source", {}});
  const HeatModel model = make_heat_model(mesh, test::rock_only(), test::matching_contacts(mesh), options);
  HeatRun run(model, until(600));
  run.advance_to(600);
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
  EXPECT_LE(run.state().time_error, 0.1);
}

TEST_P(StiffJoints, CarryTheFlowOfResistancesInSeries) {
  auto left = test::bar<2>(0.5, 4, 2, 0.1);
  auto right = left;
  right.low[0] = 0.5;
  const auto mesh = test::slab_mesh<2>({left, right});
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{GetParam()};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "left"));
  options.boundaries.push_back(test::hold(BodyId{1}, 1, 300, "right"));
  const auto contacts = test::matching_contacts(mesh);
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contacts, options);
  HeatRun run(model, until(1e12));
  run.advance_to(1e12);
  double joint = 0;
  for (const double g : joint_conduction(mesh, test::rock_only(), contacts, options.joint).conductances) joint += g;
  const double expected = 100 / (2 * 0.5 / (4 * 0.1) + 1 / joint);
  double found = 0;
  const Eigen::VectorXd leaving = model.conductance * run.state().temperature;
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node][0] < 1e-9) found += leaving[node.value()];
  }
  EXPECT_NEAR(found / expected, 1, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Range, StiffJoints, testing::Values(1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9));

// Rounding a temperature on one side of these joints changes what passes them by up to all that flows, yet the ledger closes.
// Convection at the far end so strong that the end has the temperature of its surroundings.
TEST(StiffJointsInASteadyState, CloseTheLedgerWithTheFlowOfResistancesInSeries) {
  auto left = test::bar<2>(0.5, 8, 4, 0.1);
  auto right = test::bar<2>(0.5, 7, 3, 0.1);
  right.low[0] = 0.5;
  const auto mesh = test::slab_mesh<2>({left, right});
  for (const double conductance : {1e7, 1e9, 1e10, 1e11, 1e12, 1e13}) {
    HeatOptions options = test::options_for(mesh, 300);
    options.joint.law = JointConductance{conductance};
    options.joint.model = contact::Model::overlap;
    const auto contacts = contact::find_contacts(mesh, contact_search(options.joint, mesh.bodies, {}));
    options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "left"));
    Boundary blown;
    blown.region = Region(BodyId{1}, test::between_x(1, 1));
    blown.condition = Convection{conductance, 300.0};
    blown.name = "right";
    options.boundaries.push_back(blown);
    const HeatState state = steady_state(make_heat_model(mesh, test::rock_only(), contacts, options));
    EXPECT_LT(state.ledger.relative_residual(), 1e-12) << conductance;
    const double expected = 100 * 0.1 / (1.0 / 4 + 2 / conductance);
    EXPECT_NEAR(state.ledger.by_boundary.at(0) / expected, 1, 1e-9) << conductance;
    EXPECT_NEAR(state.ledger.by_surroundings.at(0) / expected, -1, 1e-9) << conductance;
  }
}

class Conductances : public testing::TestWithParam<double> {};

// Of joints that belong to two materials of unlike conductivity, whose temperatures settle to a uniform one.
TEST_P(Conductances, KeepTheHeatOfAnInsulatedPairAndEndInItsMean) {
  auto left = test::bar<2>(0.05, 4, 2, 0.04);
  auto right = left;
  right.low[0] = 0.05;
  right.material = MaterialId{1};
  const auto mesh = test::slab_mesh<2>({left, right});
  auto materials = test::rock_only();
  materials.push_back(test::rock());
  materials[MaterialId{1}].conductivity = 400;
  HeatOptions options = test::options_for(mesh, 300);
  options.initial_temperature[BodyId{1}] = 400;
  options.joint.law = JointConductance{GetParam()};
  contact::ContactOptions search = contact_search(options.joint, mesh.bodies, {});
  const auto contacts = contact::find_contacts(mesh, search);
  ASSERT_FALSE(contacts.contacts.empty());
  const HeatModel model = make_heat_model(mesh, materials, contacts, options);
  HeatRun run(model, until(1e6));
  run.advance_to(1e6);
  EXPECT_NEAR(model.capacity.dot(run.state().temperature) / model.capacity.sum(), 350, 1e-9);
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
  // One body's capacity and the joint of 0.04 m2 relax by h A (1/C1 + 1/C2).
  const double settled = std::exp(-GetParam() * 0.04 * 2 / (2500 * 800 * 0.05 * 0.04) * 1e6);
  EXPECT_NEAR(run.state().temperature.maxCoeff(), 350 + 50 * settled, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Range, Conductances, testing::Values(1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9));

TEST(Isolated, BlocksThatTouchNothingStayAsTheyAre) {
  const auto mesh = rubble();
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "left"));
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<2>{}, options);
  HeatRun run(model, until(1e6));
  run.advance_to(1e6);
  for (const BlockId block : mesh.blocks.ids()) {
    bool held = false;
    for (const NodeId node : mesh.blocks[block].nodes) held = held || mesh.nodes[node][0] < 1e-9;
    if (held) continue;
    for (const NodeId node : mesh.blocks[block].nodes) EXPECT_EQ(run.state().temperature[node.value()], 300);
  }
}

}  // namespace
}  // namespace scree::thermal
