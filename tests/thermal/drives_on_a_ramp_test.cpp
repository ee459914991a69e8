// What jumps or rises steeply while it also rises slowly, so that no bend tells of it: closed forms.
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/thermal/lumped_cases.h"

namespace scree::thermal {
namespace {

constexpr double seconds = 1000;
constexpr double capacity = 2500 * 800;  // of the rock [J/m3/K]

// Beside `energy`, which a formula has brought in by the end [J/m3], for several tolerances.
void expect_within_stated(const std::string& formula, double energy) {
  auto row = test::row_of_cubes<2>(1, 2);
  row.options.sources.push_back({test::on(BodyId{0}), test::formula(formula), "source", {}});
  row.options.blocks.model = BlockModel::lumped;
  const HeatModel model = row.model();
  for (const double tolerance : {3.0, 1.0, 0.3, 0.1}) {
    TimeOptions time;
    time.until = time.output_every = seconds;
    time.tolerance = tolerance;
    HeatRun run(model, time);
    run.advance_to(seconds);
    const double error = std::abs(run.state().temperature[0] - (400 + energy / capacity));
    EXPECT_LE(error, 1.2 * run.state().time_error + 1e-9) << formula << ", " << tolerance;
    EXPECT_LE(error, tolerance) << formula << ", " << tolerance;
  }
}

// Less than a hundredth of what the ramp rises by.
TEST(DrivesOnARamp, ASmallJumpIsInTheError) {
  for (const double time : {510.0, 611.7, 742.3, 887.0}) {
    for (const double jump : {3e3, 1.8e4}) {
      expect_within_stated(fmt::format("2e3*t + {}*(t > {})", jump, time), 1e3 * seconds * seconds + jump * (seconds - time));
    }
  }
}

TEST(DrivesOnARamp, ASteepRiseIsInTheError) {
  for (const double time : {510.0, 742.3}) {
    for (const double width : {1.0, 4.0, 20.0}) {
      const double high = 2e4;
      const auto integral = [&](double t) {
        const double off = std::abs(t - time);
        return t + off + width * std::log1p(std::exp(-2 * off / width));
      };
      const double energy = 1e3 * seconds * seconds + high * (integral(seconds) - integral(0));
      expect_within_stated(fmt::format("2e3*t + {}*(1 + tanh((t - {})/{}))", high, time, width), energy);
    }
  }
}

}  // namespace
}  // namespace scree::thermal
