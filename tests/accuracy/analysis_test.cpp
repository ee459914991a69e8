#include "tools/accuracy/analysis.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/base/check.h"

namespace scree::accuracy {
namespace {

Measured measured(double wall, double error, double factor = 1) {
  Measured run;
  run.rung = {factor, 0.1, "implicit", "", ""};
  run.wall_seconds = wall;
  run.max_error = error;
  run.steps = 10;
  return run;
}

TEST(Analysis, FindsTheOrderOfAPowerLawWhateverItsFactor) {
  std::vector<std::pair<double, double>> points;
  for (const double size : {1.0, 0.7, 0.3, 0.1}) points.emplace_back(size, 42 * std::pow(size, 1.75));
  EXPECT_NEAR(*observed_order(points), 1.75, 1e-12);
}

TEST(Analysis, NamesNoOrderForOnePointOrEqualSizes) {
  EXPECT_FALSE(observed_order({{1.0, 0.1}}));
  EXPECT_FALSE(observed_order({{1.0, 0.1}, {1.0, 0.2}}));
  EXPECT_FALSE(observed_order({{1.0, 0.0}, {2.0, 0.0}}));
}

TEST(Analysis, FrontHoldsExactlyTheRunsThatNoOtherBeats) {
  std::vector<Measured> runs{measured(1, 1), measured(2, 0.5), measured(3, 0.6), measured(4, 0.1), measured(1.5, 1)};
  mark_front(runs);
  const std::vector<bool> expected{true, true, false, true, false};
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(runs[i].on_front, expected[i]) << i;
}

TEST(Analysis, ARunWithoutAnErrorIsNotOnTheFront) {
  std::vector<Measured> runs{measured(1, 1), measured(0.1, 0)};
  runs[1].max_error.reset();
  mark_front(runs);
  EXPECT_TRUE(runs[0].on_front);
  EXPECT_FALSE(runs[1].on_front);
}

TEST(Analysis, ReportsTheOrderInMeshSizeAtTheSmallestTolerance) {
  std::vector<Measured> runs;
  for (const double factor : {2.0, 1.0, 0.5}) {
    runs.push_back(measured(1, 3 * factor * factor, factor));
    Measured coarse_in_time = measured(1, 5, factor);
    coarse_in_time.rung.tolerance = 10;
    runs.push_back(coarse_in_time);
  }
  const auto orders = observed_orders(runs);
  ASSERT_FALSE(orders.empty());
  EXPECT_EQ(orders[0].of, "mesh size");
  EXPECT_NEAR(orders[0].order, 2, 1e-12);
}

TEST(Analysis, ErrorsAreTheLargestAndTheRootMeanSquareAfterTheStart) {
  ProbeHistory history;
  history.times = {0, 1, 2};
  history.values["a"] = {99, 3, 4};
  Measured run;
  compare(
      history, [](const std::string&, double) { return std::optional<double>(0); }, run);
  EXPECT_DOUBLE_EQ(*run.max_error, 4);
  EXPECT_DOUBLE_EQ(*run.rms_error, std::sqrt(12.5));
}

TEST(Analysis, AnExactSolutionGivesEveryRunAnErrorTheFinestToo) {
  ProbeHistory history;
  history.times = {0, 1, 2};
  history.values["a"] = {0, 3, 4};
  history.exact["a"] = {0, 3.5, 4};
  Measured run;
  compare(history, exact_of(history), run);
  EXPECT_DOUBLE_EQ(*run.max_error, 0.5);
}

TEST(Analysis, AReferenceThatKnowsNoProbeIsAnError) {
  ProbeHistory history;
  history.times = {1};
  history.values["a"] = {3};
  Measured run;
  EXPECT_THROW(compare(
                   history, [](const std::string&, double) { return std::optional<double>(); }, run),
               InputError);
}

}  // namespace
}  // namespace scree::accuracy
