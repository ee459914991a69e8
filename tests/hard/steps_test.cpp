// Steps from microseconds to decades, and a step change met by one huge step.
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/drive.h"
#include "thermal/heat_run.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {
namespace {

HeatModel hot_left_end(double beta) {
  auto slab = test::bar<2>(0.1, 10, 2, 0.02);
  slab.block_per_element = true;
  const auto mesh = test::slab_mesh<2>({slab});
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{beta};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "left"));
  return make_heat_model(mesh, test::rock_only(), test::matching_contacts(mesh), options);
}

TimeOptions until(double time, double tolerance) {
  TimeOptions options;
  options.until = time;
  options.tolerance = tolerance;
  return options;
}

TEST(Steps, FromAMicrosecondToThirtyYearsStayInTheRangeOfTheData) {
  for (const double beta : {1.0, 1e4}) {
    const HeatModel model = hot_left_end(beta);
    for (double length = 1e-6; length < 2e9; length *= 10) {
      HeatRun run(model, until(length, 1));
      run.advance_to(length);
      EXPECT_TRUE(run.state().temperature.allFinite());
      EXPECT_LE(run.state().time_error, 1) << length;
      EXPECT_LT(run.state().ledger.relative_residual(), 1e-10) << length;
    }
  }
}

// Along the negative axis the scheme's amplification never falls below -0.2071 (at z = -8.24), so each mode
// overshoots a sudden change by at most that part of it, whatever the step; the largest of all nodes by a little more, since
// joints keep the temperatures at contact points and not at nodes.
TEST(Steps, AHugeFirstStepOvershootsByLessThanAQuarterOfTheChange) {
  const HeatModel model = hot_left_end(10);
  const Eigen::VectorXd start = held(model, model.initial, Drives(model).at(0));
  const auto scheme = make_implicit_scheme(model);
  for (double length = 1; length < 1e12; length *= 3) {
    const Step step = scheme->step({0, start, Eigen::VectorXd::Zero(start.size())}, length);
    const Eigen::VectorXd after = start + step.change;
    EXPECT_LT(after.maxCoeff(), 400 + 0.25 * 100) << length;
    EXPECT_GT(after.minCoeff(), 300 - 0.25 * 100) << length;
  }
}

TEST(Steps, AnInfiniteStepEndsInTheSteadyState) {
  const HeatModel model = hot_left_end(10);
  HeatRun run(model, until(1e12, 1e-3));
  run.advance_to(1e12);
  EXPECT_NEAR(run.state().temperature.minCoeff(), 400, 1e-6);
}

}  // namespace
}  // namespace scree::thermal
