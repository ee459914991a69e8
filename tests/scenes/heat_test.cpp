// The scenes that heat without motion: scenes/slab, scenes/hexahedra and scenes/bars_and_joint.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

constexpr double celsius = 273.15;

// Li & Feng (2016), eq. (14), with T1 = 100, T2 = 0, L = 1 m.
double bar_series(double z, double t) {
  const double diffusivity = 1.6 / (0.2 * 1000);
  double sum = 100 * (1 - z);
  for (int n = 1; n <= 400; ++n) {
    sum -= 2 * 100 / M_PI / n * std::exp(-diffusivity * n * n * M_PI * M_PI * t) * std::sin(n * M_PI * z);
  }
  return sum;
}

TEST(Slab, FollowsTheSeriesAtItsProbes) {
  const SceneRun run = test::run("slab", fresh_directory("slab"));
  ASSERT_EQ(run.exit_status, 0);
  const auto columns = run.probes();
  const auto& time = columns.at("time");
  ASSERT_EQ(time.size(), 13u);
  for (std::size_t i = 1; i < time.size(); ++i) {
    EXPECT_NEAR(columns.at("near")[i] - celsius, bar_series(0.2, time[i]), 0.05);
    EXPECT_NEAR(columns.at("middle")[i] - celsius, bar_series(0.5, time[i]), 0.05);
    EXPECT_NEAR(columns.at("far")[i] - celsius, bar_series(0.8, time[i]), 0.05);
  }
  EXPECT_LT(run.summary["heat"]["ledger_residual"], 1e-8);
  EXPECT_FALSE(run.summary.contains("settle"));
}

TEST(Hexahedra, FollowTheSeriesAndSoDoWedges) {
  const SceneRun run = test::run("hexahedra", fresh_directory("hexahedra"));
  ASSERT_EQ(run.exit_status, 0);
  const auto columns = run.probes();
  const auto& time = columns.at("time");
  ASSERT_EQ(time.size(), 5u);
  for (const std::string bar : {"hexahedra", "wedges"}) {
    for (std::size_t i = 1; i < time.size(); ++i) {
      EXPECT_NEAR(columns.at(bar + "_near")[i] - celsius, bar_series(0.2, time[i]), 0.05) << bar;
      EXPECT_NEAR(columns.at(bar + "_middle")[i] - celsius, bar_series(0.5, time[i]), 0.05) << bar;
      EXPECT_NEAR(columns.at(bar + "_far")[i] - celsius, bar_series(0.8, time[i]), 0.05) << bar;
    }
  }
  EXPECT_LT(run.summary["heat"]["ledger_residual"], 1e-8);
}

TEST(BarsAndJoint, ReachTheClosedFormOfTwoSlabsAndAJoint) {
  const SceneRun run = test::run("bars_and_joint", fresh_directory("bars_and_joint"));
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_LT(run.summary["heat"]["ledger_residual"], 1e-8);
  const auto columns = run.probes();
  const double left = columns.at("left_of_joint").back() - celsius;
  const double right = columns.at("right_of_joint").back() - celsius;
  const double flux = 3.1 * (100 - left) / (0.2 - 0.0001);
  EXPECT_NEAR(3.1 * right / (0.2 - 0.0001), flux, 0.03 * flux);
  const double conductance = run.summary["joints"][0]["joint_conductance"];
  const double closed_form = 100 / (2 * 0.2 / 3.1 + 1 / conductance);
  EXPECT_NEAR(flux, closed_form, 0.03 * closed_form);
}

}  // namespace
}  // namespace scree::test
