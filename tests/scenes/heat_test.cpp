// The scenes that heat without motion: scenes/slab, scenes/hexahedra and scenes/bars_and_joint.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

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

// The largest distance from the series at the three probes, from `start` [s] on [K].
double largest_error(const SceneRun& run, double start) {
  const auto columns = run.probes();
  const auto& time = columns.at("time");
  double largest = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < start) continue;
    for (const auto& [probe, z] : {std::pair{"near", 0.2}, {"middle", 0.5}, {"far", 0.8}}) {
      largest = std::max(largest, std::abs(columns.at(probe)[i] - celsius - bar_series(z, time[i])));
    }
  }
  return largest;
}

TEST(Slab, FollowsTheSeriesAtItsProbes) {
  const SceneRun run = test::run("slab", fresh_directory("slab"), {"output.every=0.5 s"});
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_LT(largest_error(run, 2.5), 0.02);
  EXPECT_LT(largest_error(run, 0.5), 0.05) << "the front is as thin as six elements";
  EXPECT_LT(run.summary["heat"]["ledger_residual"], 1e-8);
  EXPECT_FALSE(run.summary.contains("settle"));
  std::vector<std::string> stages;
  for (const auto& stage : run.summary["stages"]) stages.push_back(stage["name"]);
  EXPECT_EQ(stages, (std::vector<std::string>{"mesh", "contacts", "assemble", "begin", "heat"}));
}

// Temperatures bend where a node enters the peak of its heat capacity or leaves it, which no polynomial through the ends of
// steps follows: outputs that steps pass would be off by three times the time error.
TEST(LatentHeat, OutputsAreWithinTheTimeErrorOfAFinerRun) {
  const auto folder = fresh_directory("latent_heat");
  std::ofstream(folder / "latent.yaml")
      << "dimension: 2\n"
         "materials: {m: {density: 1, conductivity: 1,\n"
         "  specific_heat: {table: [[250, 1], [314, 1], [314.5, 1000], [315, 1], [500, 1]]}}}\n"
         "bodies: {b: {box: {size: [1, 0.3], centre: [0.5, 0]}, material: m, mesh_size: 0.2, elements: quadrilateral}}\n"
         "heat: {initial: 300, boundaries: [{body: b, surface: x_low, flux: 60}], until: 0.32, tolerance: 0.1}\n"
         "output: {every: 0.0032, probes: {p: [0, -0.15]}}\n";
  const SceneRun run = run_file(folder / "latent.yaml", folder / "coarse");
  const SceneRun fine = run_file(folder / "latent.yaml", folder / "fine", {"heat.tolerance=0.0001"});
  ASSERT_EQ(run.exit_status, 0);
  ASSERT_EQ(fine.exit_status, 0);
  const auto coarse_at = run.probes().at("p"), fine_at = fine.probes().at("p");
  ASSERT_EQ(coarse_at.size(), 101);
  double largest = 0;
  for (std::size_t i = 0; i < coarse_at.size(); ++i) largest = std::max(largest, std::abs(coarse_at[i] - fine_at[i]));
  EXPECT_LT(largest, run.summary["heat"]["time_error"].get<double>());
}

// A millionth of a watt for a second: rounding the temperatures of rock at 300 K is worth more.
TEST(Slab, IsSoundWhereNextToNoHeatFlows) {
  const SceneRun run = test::run(
      "slab", fresh_directory("little_heat"),
      {"heat.initial=300", "heat.boundaries=[{body: bar, surface: x_low, flux: 1e-6}]", "heat.until=1 s", "output.every=1 s"});
  EXPECT_EQ(run.exit_status, 0) << run.summary.dump(1);
}

TEST(Slab, FollowsTheSeriesToAHundredthWithAFineTolerance) {
  const SceneRun run = test::run("slab", fresh_directory("slab_fine"), {"output.every=0.5 s", "heat.tolerance=0.002 K"});
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_LT(largest_error(run, 4), 0.01);
}

TEST(Slab, FollowsTheSeriesToAHundredthAtAllTimesOnHalfTheMeshSize) {
  const SceneRun run = test::run("slab", fresh_directory("slab_half"),
                                 {"output.every=0.5 s", "heat.tolerance=0.002 K", "bodies.bar.mesh_size=0.005"});
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_LT(largest_error(run, 0.5), 0.01);
}

TEST(PapersBar, FollowsTheSeriesWithinTwoHundredthsOverTheWholeHistory) {
  const SceneRun run = test::run("bar", fresh_directory("bar"));
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_EQ(run.summary["elements"], 398);
  EXPECT_LT(largest_error(run, 0.5), 0.02);
}

TEST(PapersBar, FollowsTheSeriesWithinAHundredthFromOneSecondOnWithAFineTolerance) {
  const SceneRun run = test::run("bar", fresh_directory("bar_fine"), {"heat.tolerance=0.002 K"});
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_LT(largest_error(run, 1), 0.01);
  EXPECT_LT(largest_error(run, 0.5), 0.012);
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

// Steps in time may undershoot by what they may be off.
TEST(Slab, MayBeHeldAtZeroKelvin) {
  const SceneRun run =
      test::run("slab", fresh_directory("slab_at_zero"),
                {"heat.initial=4 K", "heat.integrator=implicit", "output.probes=null", "heat.until=2000 s", "output.every=20 s",
                 "heat.boundaries=[{body: bar, within: {low: [0, -1], high: [0, 1]}, temperature: 0 K}]"});
  EXPECT_EQ(run.exit_status, 0);
  EXPECT_LT(run.summary["heat"]["least_temperature_ever"].get<double>(), 0);
}

}  // namespace
}  // namespace scree::test
