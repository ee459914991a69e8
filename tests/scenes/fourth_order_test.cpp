// scenes/hot_floor: fourth order in space, through the command.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

TEST(HotFloor, IsTwentyTimesAsExactAsInSecondOrder) {
  const SceneRun fourth = test::run("hot_floor", fresh_directory("hot_floor"));
  const SceneRun second = test::run("hot_floor", fresh_directory("hot_floor_second"), {"heat.space_order=2"});
  ASSERT_EQ(fourth.exit_status, 0);
  const auto& heat = fourth.summary["heat"];
  EXPECT_LT(heat["exact_error"], 0.05);
  EXPECT_GT(second.summary["heat"]["exact_error"], 20 * 0.04);
  EXPECT_LT(heat["time_error"], heat["tolerance"]);
  EXPECT_LT(heat["ledger_residual"], 1e-12);
  EXPECT_GT(heat["overshoot"], 5);  // told, not hidden
  EXPECT_EQ(second.summary["heat"]["overshoot"], 0);
}

// A run that goes on takes the state as it is, without another jump at the floor.
TEST(HotFloor, GoesOnWhereItEnded) {
  const auto folder = fresh_directory("hot_floor_on");
  ASSERT_EQ(test::run("hot_floor", folder, {"heat.until=6 h"}).exit_status, 0);
  const SceneRun half =
      test::run("hot_floor", fresh_directory("hot_floor_from"), {"heat.initial={from: " + folder.string() + "}"});
  const SceneRun whole = test::run("hot_floor", fresh_directory("hot_floor_whole"), {"heat.until=18 h"});
  ASSERT_EQ(half.exit_status, 0);
  for (const char* probe : {"low", "middle", "high"}) {
    EXPECT_NEAR(half.probes().at(probe).back(), whole.probes().at(probe).back(), 0.05) << probe;
  }
  EXPECT_LT(half.summary["heat"]["overshoot"], 1e-9);
}

TEST(HotFloor, IsRefusedWhereStepsAreImplicit) {
  try {
    test::run("hot_floor", fresh_directory("hot_floor_implicit"), {"heat.integrator=implicit"});
    FAIL() << "it ran";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(),
                testing::ContainsRegex("hot_floor.yaml:15:16: heat.space_order is 4 .must be done in stabilised"));
  }
}

}  // namespace
}  // namespace scree::test
