// scenes/blown_cubes: blocks of one temperature, chosen by their Biot number.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

TEST(BlownCubes, LumpsTheSteelAndMeshesTheBrick) {
  const SceneRun run = test::run("blown_cubes", fresh_directory("blown"));
  ASSERT_EQ(run.exit_status, 0);
  const auto& heat = run.summary["heat"];
  EXPECT_EQ(heat["lumped_blocks"]["count"], 27);
  EXPECT_EQ(heat["lumped_blocks"]["temperatures"], 27 + 9 * 9 * 9);
  EXPECT_LT(heat["lumped_blocks"]["largest_biot"], 0.01);
  EXPECT_LT(heat["exact_error"], heat["tolerance"]);
  EXPECT_LT(heat["ledger_residual"], 1e-12);
  EXPECT_EQ(listed_frames(run.directory / "heat.pvd").size(), 4u);
}

TEST(BlownCubes, DifferFromTheMeshedRunByLessThanTheEstimate) {
  const std::vector<std::string> corner{"output.probes.corner=[0.03, 0.03, 0.03]"};
  const SceneRun lumped = test::run("blown_cubes", fresh_directory("blown_lumped"), corner);
  const SceneRun meshed = test::run("blown_cubes", fresh_directory("blown_meshed"), {corner[0], "heat.blocks.model=meshed"});
  EXPECT_FALSE(meshed.summary["heat"].contains("lumped_blocks"));
  double largest = 0;
  for (const char* probe : {"steel", "corner", "brick"}) {
    const auto a = lumped.probes().at(probe), b = meshed.probes().at(probe);
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  const double estimate = lumped.summary["heat"]["lumped_blocks"]["error"];
  EXPECT_LT(largest, estimate);
  EXPECT_LT(estimate, 2 * largest);
}

TEST(BlownCubes, AreRefusedWhereABoundaryHoldsPartOfALumpedBlock) {
  EXPECT_THAT(refusal("slab", fresh_directory("lumped_slab"), {"heat.blocks={model: lumped}"}),
              testing::ContainsRegex("slab.yaml:[0-9]+:[0-9]+: heat.blocks is a lumped block of bar, of which .* holds"));
}

}  // namespace
}  // namespace scree::test
