// Falls that are hard on a contact solver: each ends well, or says that it did not.
#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

SceneRun fall(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const auto scene = std::filesystem::path(SCREE_SOURCE_DIR) / "tests/hard/scenes" / (name + ".yaml");
  return run_file(scene, fresh_directory("hard_" + name), overrides);
}

TEST(HardFalls, AStackOfFortyStandsAndComesToRest) {
  const SceneRun run = fall("stack_of_forty");
  EXPECT_EQ(run.exit_status, 0) << run.summary["reasons"];
  EXPECT_TRUE(run.summary["settle"]["at_rest"]);
  EXPECT_NEAR(run.summary["settle"]["top"].get<double>(), 4.0, 1e-4);
}

TEST(HardFalls, AStackOfFortyThatStillSwaysIsNotCalledAtRest) {
  const SceneRun run = fall("stack_of_forty", {"settle.local_damping=0", "settle.limit=1 s"});
  EXPECT_EQ(run.exit_status, 1);
  EXPECT_EQ(run.summary["status"], "not_settled");
}

TEST(HardFalls, AMassRatioOfAMillionIsSaidToBeTooMuch) {
  const SceneRun run = fall("ton_on_a_pebble");
  EXPECT_EQ(run.exit_status, 1);
  EXPECT_GT(run.summary["settle"]["deepest_overlap"].get<double>(), 0.5);
  EXPECT_NE(run.summary["reasons"].dump().find("pressed into another"), std::string::npos);
}

TEST(HardFalls, AMassRatioOfAHundredIsBorneByAThousandIterations) {
  const SceneRun run =
      fall("ton_on_a_pebble", {"materials.heavy.density=100000", "settle.iterations=1000",
                               "bodies.large.box.size=[0.05, 0.05, 0.05]", "bodies.large.box.centre=[0, 0, 0.075]"});
  EXPECT_EQ(run.exit_status, 0) << run.summary["reasons"];
  EXPECT_NEAR(run.summary["settle"]["top"].get<double>(), 0.1, 1e-4);
}

TEST(HardFalls, ABlockDroppedFromAHundredMetresStopsOnThePlate) {
  const SceneRun run = fall("drop_of_100_m");
  EXPECT_EQ(run.exit_status, 0) << run.summary["reasons"];
  EXPECT_NEAR(run.summary["settle"]["top"].get<double>(), 0.1, 1e-5);
  EXPECT_EQ(run.summary["settle"]["lost_blocks"], 0);
}

TEST(HardFalls, BlocksThatStartInEachOtherComeApartWithoutAnExplosion) {
  const SceneRun run = fall("overlapping_start");
  EXPECT_EQ(run.exit_status, 0) << run.summary["reasons"];
  EXPECT_EQ(run.summary["settle"]["lost_blocks"], 0);
  EXPECT_LT(run.summary["settle"]["max_penetration"].get<double>(), 1e-4);
  EXPECT_LT(run.summary["settle"]["top"].get<double>(), 0.35);
  const std::string remark = run.summary["remarks"][0];
  EXPECT_TRUE(remark.starts_with("suspicious: block ") && remark.ends_with(" m before anything moves")) << remark;
}

TEST(HardFalls, BlocksThatStartDeepInEachOtherAreNamed) {
  const SceneRun run = fall("overlapping_start", {"bodies.cubes.lattice.spacing=[0.03, 0.03, 0.03]", "settle.limit=1 s"});
  EXPECT_EQ(run.exit_status, 1);
  const std::string reasons = run.summary["reasons"].dump();
  EXPECT_NE(reasons.find("pressed into another"), std::string::npos) << reasons;
  EXPECT_NE(reasons.find("overlap by 0.07 m before anything moves. Move them apart"), std::string::npos) << reasons;
}

}  // namespace
}  // namespace scree::test
