// Joints from almost open to almost none, and blocks that touch nothing.
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/joint_conduction.h"

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
  // Above a thousand the factorisation's rounding, in proportion to the stiffness, is what is missing.
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10 * std::max(1.0, GetParam() / 1e5));
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
