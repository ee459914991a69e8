#include "thermal/step_forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/stable_step.h"

namespace scree::thermal {
namespace {

TimeOptions times(double until, double every) {
  TimeOptions options;
  options.until = until;
  options.output_every = every;
  options.tolerance = 0.2;
  options.integrator = Integrator::implicit;
  return options;
}

HeatModel suddenly_heated(double beta) {
  const auto left = test::bar<2>(0.06, 12, 4, 0.02);
  auto right = left;
  right.low[0] = 0.06;
  const auto mesh = test::slab_mesh<2>({left, right});
  HeatOptions options = test::options_for(mesh, 298.15);
  options.joint.law = StiffnessFactor{beta};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 373.15, "left"));
  return make_heat_model(mesh, test::rock_only(), test::matching_contacts(mesh), options);
}

TEST(StepForecast, OfStepsAndTheirLengthsIsWithinAFactorOfFourOfThoseTaken) {
  for (const double beta : {1.0, 1e3}) {
    const HeatModel model = suddenly_heated(beta);
    for (const double every : {60.0, 3600.0}) {
      const TimeOptions options = times(4 * every, every);
      const StepForecast forecast = forecast_steps(stable_step(model).step, options);
      HeatRun run(model, options);
      for (int k = 1; k <= 4; ++k) run.advance_to(k * every);
      const auto steps = static_cast<double>(run.state().steps);
      const auto lengths = static_cast<double>(run.state().factorisations);
      EXPECT_GT(forecast.steps, steps / 4) << beta << ' ' << every;
      EXPECT_LT(forecast.steps, 4 * steps) << beta << ' ' << every;
      EXPECT_GT(forecast.lengths, lengths / 4) << beta << ' ' << every;
      EXPECT_LT(forecast.lengths, 4 * lengths) << beta << ' ' << every;
    }
  }
}

TEST(StepForecast, OfProductsIsTheSumOverTheStepsThatGrow) {
  const double stable = 0.5;
  const double until = 5000;
  double sum = 0;
  for (double length = 0.15 * until; length > 1e-12; length *= std::exp(-0.15)) sum += 2 * std::sqrt(length / stable);
  EXPECT_NEAR(forecast_steps(stable, times(until, until)).products, sum, 1e-3 * sum);
}

TEST(StepForecast, WhereNothingConductsIsOneStepAnOutput) {
  const StepForecast forecast = forecast_steps(std::numeric_limits<double>::infinity(), times(100, 10));
  EXPECT_DOUBLE_EQ(forecast.steps, 10);
  EXPECT_DOUBLE_EQ(forecast.lengths, 1);
  EXPECT_DOUBLE_EQ(forecast.products, 0);
}

TEST(WorkDone, IsAboutThePartOfTheStepsThatARunHasTakenAndNotThatOfItsTime) {
  const TimeOptions options = times(4 * 3600, 3600);
  HeatRun run(suddenly_heated(10), options);
  WorkDone work(options, run.cost_exponent());
  std::vector<double> parts, passed;
  for (int k = 1; k <= 4; ++k) {
    run.advance_to(k * 3600, [&](double time) {
      parts.push_back(work.part(time));
      passed.push_back(time / options.until);
    });
  }
  double of_work = 0, of_time = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double steps = static_cast<double>(i + 1) / static_cast<double>(parts.size());
    of_work = std::max(of_work, std::abs(parts[i] - steps));
    of_time = std::max(of_time, std::abs(passed[i] - steps));
  }
  EXPECT_LT(of_work, 0.2);
  EXPECT_GT(of_time, 0.6);
  EXPECT_DOUBLE_EQ(parts.back(), 1);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
}

TEST(WorkDone, OfStabilisedStepsIsThePartOfTheirProducts) {
  const double stable = 0.5;
  WorkDone work(times(5000, 1000), 0.5);
  EXPECT_NEAR(work.part(200),
              forecast_steps(stable, times(200, 200)).products / forecast_steps(stable, times(5000, 1000)).products, 0.02);
  EXPECT_NEAR(work.part(3000),
              forecast_steps(stable, times(3000, 1000)).products / forecast_steps(stable, times(5000, 1000)).products, 0.02);
}

TEST(WorkDone, OfEqualStepsIsThePartOfTheTime) {
  WorkDone work(times(5000, 1000), 1);
  for (const double time : {100.0, 900.0, 1000.0, 1700.0, 5000.0}) EXPECT_NEAR(work.part(time), time / 5000, 1e-12);
}

}  // namespace
}  // namespace scree::thermal
