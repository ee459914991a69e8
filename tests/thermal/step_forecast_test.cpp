#include "thermal/step_forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
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
      const StepForecast forecast = forecast_steps(stable_step(model).step, step_times(options, false));
      HeatRun run(model, options);
      run.advance_to(options.until);
      const auto steps = static_cast<double>(run.state().steps);
      const auto lengths = static_cast<double>(run.state().factorisations);
      EXPECT_GT(forecast.steps, steps / 4) << beta << ' ' << every;
      EXPECT_LT(forecast.steps, 4 * steps) << beta << ' ' << every;
      EXPECT_GT(forecast.lengths, lengths / 4) << beta << ' ' << every;
      EXPECT_LT(forecast.lengths, 4 * lengths) << beta << ' ' << every;
    }
  }
}

// One after the other: halves of the longest one, each as long as a fifth of the time that has passed allows.
std::vector<double> steps_one_by_one(double first, const StepTimes& times) {
  std::vector<double> lengths;
  for (double time = 0; time < times.until - 1e-9; time += lengths.back()) {
    double length = times.longest;
    while (length > std::max(first, time / 5)) length /= 2;
    lengths.push_back(length);
  }
  return lengths;
}

double products_of(double length, double stable) {
  return 2 * std::sqrt(length / stable);
}

double products_of(const std::vector<double>& steps, double stable) {
  double sum = 0;
  for (const double length : steps) sum += products_of(length, stable);
  return sum;
}

TEST(StepForecast, IsWhatStepsThatGrowOneByOneAddUpTo) {
  const double stable = 0.5;
  for (const double longest : {5000, 1000, 50}) {
    const StepTimes range{5000, longest};
    const std::vector<double> steps = steps_one_by_one(stable, range);
    const StepForecast forecast = forecast_steps(stable, range);
    EXPECT_NEAR(forecast.steps, static_cast<double>(steps.size()), 0.05 * forecast.steps);
    EXPECT_NEAR(forecast.products, products_of(steps, stable), 0.05 * forecast.products);
    EXPECT_EQ(forecast.lengths, static_cast<double>(std::set<double>(steps.begin(), steps.end()).size()));
  }
}

// Every length may be the longest of the short ones.
TEST(StepMix, CostsLeastOfAll) {
  const double stable = 0.01;
  const StepTimes range{43200, 600};
  const std::vector<double> steps = steps_one_by_one(stable, range);
  const std::set<double> lengths(steps.begin(), steps.end());
  std::set<double> taken;
  for (const double solve : {1.0, 10.0, 1e2, 1e3}) {
    for (const double matrix : {0.0, 1e2, 1e4}) {
      const SolverCost solver{matrix, solve};
      const auto seconds = [&](double longest_short) {
        double sum = 0;
        std::set<double> made;
        for (const double length : steps) {
          if (length > longest_short) made.insert(length);
          sum += length > longest_short ? 4 * solve : products_of(length, stable);
        }
        return sum + matrix * static_cast<double>(made.size());
      };
      double least = seconds(0);
      for (const double length : lengths) least = std::min(least, length < range.longest ? seconds(length) : least);
      const StepMix mix = cheapest_mix(stable, range, {1}, solver);
      EXPECT_LE(seconds(mix.longest_short), 1.03 * least) << solve << ' ' << matrix;
      EXPECT_NEAR(mix.seconds, seconds(mix.longest_short), 0.05 * least) << solve << ' ' << matrix;
      taken.insert(mix.longest_short);
    }
  }
  EXPECT_GE(taken.size(), 5);
}

TEST(StepMix, LeavesAllStepsImplicitWhereSolvesCostNothing) {
  EXPECT_EQ(cheapest_mix(0.01, {43200, 600}, {1}, {}).longest_short, 0);
}

// Four solves of 5 cost as much as the twenty products of a step of 100 stable ones.
TEST(StepMix, LeavesNoStepExplicitThatCostsMoreThanItsSolvesWhereAnyLengthMayLast) {
  const SolverCost solver{1e4, 5};
  const double once = cheapest_mix(1, {51200, 3200}, {1, use_of_linear_steps, false}, solver).longest_short;
  EXPECT_GT(once, 100);
  EXPECT_EQ(cheapest_mix(1, {51200, 3200}, {1, use_of_linear_steps, true}, solver).longest_short, 100);
}

TEST(StepForecast, TakesStepsThatPassAPowerOfTwoOfOutputs) {
  EXPECT_EQ(step_times(times(43200, 600), false).longest, 64 * 600);
  EXPECT_EQ(step_times(times(43200, 600), true).longest, 600);
  EXPECT_EQ(step_times(times(43200, 60), true).longest, 8 * 60) << "675 s at most";
  EXPECT_EQ(step_times(times(1000, 600), false).longest, 600);
  EXPECT_EQ(step_times(times(500, 600), true).longest, 500);
  EXPECT_EQ(step_times(times(500, 0), true).longest, 500);
}

TEST(StepForecast, WhereNothingConductsIsOfTheLongestSteps) {
  const StepForecast forecast = forecast_steps(std::numeric_limits<double>::infinity(), {100, 10});
  EXPECT_DOUBLE_EQ(forecast.steps, 10);
  EXPECT_DOUBLE_EQ(forecast.lengths, 1);
  EXPECT_DOUBLE_EQ(forecast.products, 0);
}

TEST(WorkDone, IsAboutThePartOfTheStepsThatARunHasTakenAndNotThatOfItsTime) {
  const TimeOptions options = times(4 * 3600, 3600);
  HeatRun run(suddenly_heated(10), options);
  WorkDone work = run.work_done();
  std::vector<double> parts, passed;
  run.advance_to(options.until, [&](double time) {
    parts.push_back(work.part(time));
    passed.push_back(time / options.until);
  });
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
  const StepTimes range{5000, 1000};
  const std::vector<double> steps = steps_one_by_one(0.5, range);
  WorkDone work(range, 0.5);
  EXPECT_GT(work.part(steps.front()), 0);
  double time = 0, products = 0;
  for (const double length : steps) {
    time += length;
    products += products_of(length, 0.5);
    EXPECT_NEAR(work.part(time), products / products_of(steps, 0.5), 0.02) << time;
  }
}

TEST(WorkDone, OfEqualStepsIsThePartOfTheTime) {
  WorkDone work({5000, 1000}, 1);
  for (const double time : {100.0, 900.0, 1000.0, 1700.0, 5000.0}) EXPECT_NEAR(work.part(time), time / 5000, 1e-12);
}

}  // namespace
}  // namespace scree::thermal
