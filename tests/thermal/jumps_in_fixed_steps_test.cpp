// Steps of a given length that something jumps within: what they miss is in the stated error, wherever in a step it is.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/thermal/lumped_cases.h"

namespace scree::thermal {
namespace {

constexpr double step = 10;
constexpr double seconds = 20;
constexpr double capacity = 2500 * 800;  // of the rock [J/m3/K]

// Of a block that a source of `power` heats from `time` on, in closed form.
TEST(JumpsInFixedSteps, ASourceThatSetsInIsInTheErrorOfEuler) {
  const double power = 2e5;
  for (const double time : {0.5, 2.0, 5.0, 7.5, 8.0, 8.5, 9.07, 9.3, 9.7, 9.9, 14.1, 19.07}) {
    auto row = test::row_of_cubes<2>(1, 2);
    row.options.sources.push_back(
        {test::on(BodyId{0}), test::formula(fmt::format("t < {} ? 0 : {}", time, power)), "source", {}});
    row.options.blocks.model = BlockModel::lumped;
    const HeatModel model = row.model();
    TimeOptions options;
    options.until = options.output_every = seconds;
    options.integrator = Integrator::explicit_euler;
    options.step = step;
    options.tolerance = 100;
    HeatRun run(model, options);
    run.advance_to(seconds);
    const double error = std::abs(run.state().temperature[0] - (400 + power * (seconds - time) / capacity));
    EXPECT_LE(error, run.state().time_error) << time;
    EXPECT_LE(run.state().time_error, error + 0.08 * step * power / capacity) << time;
  }
}

}  // namespace
}  // namespace scree::thermal
