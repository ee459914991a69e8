// scenes/small_pile: the whole chain.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "engine/base/progress.h"
#include "tests/scenes/scene_run.h"
#include "tools/run/run_scene.h"
#include "tools/scene/read_scene.h"

namespace scree::test {
namespace {

class SmallPile : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { run_ = new SceneRun(test::run("small_pile", fresh_directory("small_pile"))); }
  static void TearDownTestSuite() { delete run_; }

  static inline SceneRun* run_ = nullptr;
};

TEST_F(SmallPile, IsCompleteAndSound) {
  EXPECT_EQ(run_->exit_status, 0);
  EXPECT_EQ(run_->summary["status"], "complete");
  EXPECT_GT(run_->summary["blocks"], 200);
  EXPECT_TRUE(run_->summary["settle"]["at_rest"]);
  EXPECT_LT(run_->summary["heat"]["ledger_residual"], 1e-8);
  EXPECT_LE(run_->summary["heat"]["time_error"], 0.1);
}

TEST_F(SmallPile, DoesNotPenetrate) {
  const auto& settle = run_->summary["settle"];
  const double edge = settle["mean_edge"];
  EXPECT_LT(settle["max_penetration"], 0.01 * edge);
  EXPECT_LT(settle["mean_penetration"], 0.001 * edge);
}

// Linear elements with obtuse angles and contacts that interpolate within their faces have no strict maximum principle; what
// they give up is small against the range of 75 K.
TEST_F(SmallPile, StaysBetweenItsInitialAndItsBoundaryTemperatureToTwoPercentOfTheirRange) {
  EXPECT_GT(run_->summary["heat"]["least_temperature"], 273.15 + 25 - 1.5);
  EXPECT_LT(run_->summary["heat"]["largest_temperature"], 273.15 + 100 + 1.5);
}

TEST_F(SmallPile, WarmsAtItsProbe) {
  const auto columns = run_->probes();
  const auto& inside = columns.at("inside");
  ASSERT_EQ(inside.size(), 13u);
  EXPECT_DOUBLE_EQ(inside.front(), 273.15 + 25);
  EXPECT_GT(inside.back(), 273.15 + 50);
}

TEST_F(SmallPile, DiffersFromAHundredthOfItsToleranceByLessThanItsTolerance) {
  const auto directory = fresh_directory("small_pile_finer");
  std::filesystem::copy(run_->directory / "packing.h5", directory / "packing.h5");
  const SceneRun finer = test::run("small_pile", directory, {"heat.tolerance=0.001 K"});
  EXPECT_EQ(finer.exit_status, 0);
  EXPECT_GT(finer.summary["heat"]["steps"], 3 * run_->summary["heat"]["steps"].get<int>());
  const auto coarse = run_->probes().at("inside");
  const auto fine = finer.probes().at("inside");
  double largest = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) largest = std::max(largest, std::abs(coarse[i] - fine[i]));
  EXPECT_LT(largest, 0.1);
  EXPECT_GT(largest, 0.0);
}

TEST_F(SmallPile, NamesTheNearestBlockOfAProbeInAVoid) {
  const auto directory = fresh_directory("small_pile_void");
  std::filesystem::copy(run_->directory / "packing.h5", directory / "packing.h5");
  const std::string lost = refusal("small_pile", directory, {"output.probes.inside={point: [0, 0, 0.6], reach: 0}"});
  EXPECT_NE(lost.find("nearest"), std::string::npos) << lost;
  EXPECT_FALSE(std::filesystem::exists(directory / "heat.pvd"));
  EXPECT_FALSE(std::filesystem::exists(directory / "summary.json"));
}

TEST_F(SmallPile, RefusesADamagedPackingWhereTheSceneNamesIt) {
  const auto directory = fresh_directory("small_pile_damaged");
  const std::string file = (directory / "broken.h5").string();
  std::filesystem::copy(run_->directory / "packing.h5", file);
  std::filesystem::resize_file(file, 1000);
  EXPECT_EQ(refusal("small_pile", directory / "out", {"settle=null", "packing=" + file}),
            "--set packing: packing is " + file +
                ", damaged (must be a whole packing). Give the packing.h5 of a run, or settle the scene again");
}

TEST_F(SmallPile, StatesTheCostOfEveryStage) {
  std::vector<std::string> names;
  for (const auto& stage : run_->summary["stages"]) {
    names.push_back(stage["name"]);
    EXPECT_GE(stage["wall_seconds"], 0);
    EXPECT_GT(stage["peak_memory_bytes"], 1e6);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"mesh", "settle", "certificate", "contacts", "assemble", "heat", "areas"}));
}

TEST_F(SmallPile, ListsOnlyFramesThatAreThere) {
  for (const char* series : {"settle.pvd", "heat.pvd", "contacts.pvd"}) {
    const auto frames = listed_frames(run_->directory / series);
    EXPECT_GE(frames.size(), 2u) << series;
    for (const auto& frame : frames) EXPECT_TRUE(std::filesystem::exists(run_->directory / frame)) << frame;
  }
}

TEST_F(SmallPile, UsesThePackingItHasWhenOnlyTheHeatChanges) {
  const auto directory = fresh_directory("small_pile_reheated");
  std::filesystem::copy(run_->directory / "packing.h5", directory / "packing.h5");
  const SceneRun again = test::run("small_pile", directory, {"contact.stiffness_factor=1"});
  EXPECT_EQ(again.exit_status, 0);
  EXPECT_TRUE(again.summary["settle"]["reused"]);
  EXPECT_LT(again.probes().at("inside").back(), run_->probes().at("inside").back());
  for (const auto& stage : again.summary["stages"]) EXPECT_NE(stage["name"], "settle");
}

TEST_F(SmallPile, SettlesAnewWhenTheFrictionChanges) {
  const auto directory = fresh_directory("small_pile_smoother");
  std::filesystem::copy(run_->directory / "packing.h5", directory / "packing.h5");
  const SceneRun again =
      test::run("small_pile", directory, {"materials.rock.friction=0.5", "settle.limit=0.3 s", "settle.accept_moving=true"});
  EXPECT_FALSE(again.summary["settle"]["reused"]);
  EXPECT_NE(again.summary["settle"]["packing_key"], run_->summary["settle"]["packing_key"]);
}

TEST_F(SmallPile, RefusesAClearanceAcrossWhichNoHeatWouldBeLookedFor) {
  const auto directory = fresh_directory("small_pile_apart");
  EXPECT_NE(refusal("small_pile", directory, {"settle.clearance=1 mm"}).find("settle.clearance"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(directory));
}

TEST_F(SmallPile, RefusesAStoredPackingWhoseClearanceTheContactsNoLongerReachAcross) {
  const auto directory = fresh_directory("small_pile_reach");
  const std::vector<std::string> apart = {"settle.clearance=0.05 mm", "settle.limit=0.1 s", "settle.accept_moving=true"};
  ASSERT_EQ(test::run("small_pile", directory, apart).exit_status, 0);
  auto nearer = apart;
  nearer.push_back("contact.tolerance=1e-5");
  EXPECT_NE(refusal("small_pile", directory, nearer).find("settle.clearance"), std::string::npos);
}

TEST_F(SmallPile, OfAPackingThatWasStillMovingIsHeatedWithAWord) {
  const auto directory = fresh_directory("small_pile_moving");
  ASSERT_EQ(test::run("small_pile", directory, {"settle.limit=0.3 s", "heat.until=5 min"}).exit_status, 1);
  const auto said = [&](const std::filesystem::path& packing) {
    const Scene scene = read_scene(std::filesystem::path(SCREE_SOURCE_DIR) / "scenes" / "small_pile.yaml",
                                   {"settle=null", "packing=" + packing.string(), "heat.until=5 min", "output.probes=null"});
    testing::internal::CaptureStderr();
    Progress progress(ProgressMode::lines);
    EXPECT_EQ(run::run_scene(scene, {fresh_directory("small_pile_moving_heated")}, run::Start::fresh, progress), 0);
    return testing::internal::GetCapturedStderr();
  };
  const char* words = "packing: its blocks were still moving when it was written";
  EXPECT_NE(said(directory / "packing.h5").find(words), std::string::npos);
  EXPECT_EQ(said(run_->directory / "packing.h5").find(words), std::string::npos);
}

TEST_F(SmallPile, IsNotHeatedAsABodyThatItsPackingDoesNotHold) {
  const std::string packing = "packing=" + (run_->directory / "packing.h5").string();
  const auto refused = [&](const std::vector<std::string>& changes) {
    std::vector<std::string> overrides{packing, "heat.until=5 min"};
    overrides.insert(overrides.end(), changes.begin(), changes.end());
    return refusal("small_pile_reheated", fresh_directory("small_pile_other"), overrides);
  };
  EXPECT_THAT(
      refused({"bodies.cube.box.size=[0.2, 0.2, 0.3]"}),
      testing::EndsWith("/small_pile_reheated.yaml:17:10: bodies.cube.box is (0.2, 0.2, 0.3) m (must be as in the packing: "
                        "(0.2, 0.2, 0.2) m). Say what the scene that made the packing says, or settle anew"));
  for (const char* change : {"bodies.cube.mesh_size=0.06", "bodies.cube.blocks=whole", "bodies.cube.elements=hexahedron",
                             "bodies.plate.box.centre=[0, 0, -0.05]"}) {
    EXPECT_NE(refused({change}), "accepted") << change;
  }
  EXPECT_NE(refused({"bodies.cube.box=null", "bodies.cube.sphere={diameter: 0.2, centre: [0, 0, 0.12]}"}), "accepted");
  EXPECT_EQ(refused({"bodies.cube.box.centre=[0, 0, 0.5]", "bodies.cube.mesh_size=50 mm"}), "accepted")
      << "it has fallen since";
}

TEST_F(SmallPile, CanStartFromAPackingFile) {
  const SceneRun again = test::run("small_pile_reheated", fresh_directory("small_pile_from_file"),
                                   {"packing=" + (run_->directory / "packing.h5").string()});
  EXPECT_EQ(again.exit_status, 0);
  EXPECT_EQ(contents(again.directory / "probes.csv"), contents(run_->directory / "probes.csv"));
}

TEST_F(SmallPile, IsReproducedByTheEffectiveSceneItLeaves) {
  const auto directory = fresh_directory("small_pile_again");
  std::filesystem::copy(run_->directory / "packing.h5", directory / "packing.h5");
  const SceneRun again = test::run_file(run_->directory / "scene.yaml", directory);
  EXPECT_EQ(contents(again.directory / "probes.csv"), contents(run_->directory / "probes.csv"));
  EXPECT_EQ(again.summary["scene_hash"], run_->summary["scene_hash"]);
}

}  // namespace
}  // namespace scree::test
