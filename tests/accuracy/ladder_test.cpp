#include "tools/accuracy/ladder.h"

#include <gtest/gtest.h>

#include "tools/scene/read_scene.h"

namespace scree::accuracy {
namespace {

Scene scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(std::filesystem::path(SCREE_SOURCE_DIR) / "scenes" / (name + ".yaml"), overrides);
}

TEST(Ladder, VariesMeshAndToleranceUnlessTold) {
  const Scene slab = scene("slab");
  const auto ladder = ladder_of(slab, {});
  EXPECT_EQ(ladder.size(), 9u);
  EXPECT_DOUBLE_EQ(ladder.front().mesh_factor, 2);
  const Rung& best = ladder[finest(ladder)];
  EXPECT_DOUBLE_EQ(best.mesh_factor, 0.5);
  EXPECT_DOUBLE_EQ(best.tolerance, 0.1 * slab.heat->time.tolerance);
}

TEST(Ladder, NeedsAnErrorToFindAndNoRunTwice) {
  LadderOptions options;
  options.mesh_factors = {1};
  options.tolerances = {0.1};
  EXPECT_EQ(ladder_of(scene("slab"), options).size(), 1u);  // it names its exact solution
  EXPECT_THROW(ladder_of(scene("bars_and_joint"), options), InputError);
  options.tolerances = {0.1, 1};
  EXPECT_EQ(ladder_of(scene("bars_and_joint"), options).size(), 2u);
  options.tolerances = {0.1, 0.1};
  EXPECT_THROW(ladder_of(scene("slab"), options), InputError);
}

TEST(Ladder, LeavesTheMeshOfBlocksThatFallAlone) {
  for (const Rung& rung : ladder_of(scene("small_pile"), {})) EXPECT_DOUBLE_EQ(rung.mesh_factor, 1);
  LadderOptions options;
  options.mesh_factors = {1, 0.5};
  EXPECT_THROW(ladder_of(scene("small_pile"), options), InputError);
}

TEST(Ladder, VariesTheMeshInsideASurfaceFileWhateverTheLettersOfItsName) {
  Scene slab = scene("slab");
  for (const char* file : {"stone.stl", "STONE.STL"}) {
    for (mesh::BodySpec& body : slab.bodies) body.shape = mesh::MeshFile{file};
    EXPECT_EQ(ladder_of(slab, {}).size(), 9u) << file;
  }
  for (mesh::BodySpec& body : slab.bodies) body.shape = mesh::MeshFile{"stone.msh"};
  for (const Rung& rung : ladder_of(slab, {})) EXPECT_DOUBLE_EQ(rung.mesh_factor, 1);
}

TEST(Ladder, RunsTheExplicitSchemeOncePerMeshSinceItsStepsFollowFromStability) {
  LadderOptions options;
  options.mesh_factors = {1};
  options.integrators = {"explicit_euler"};
  EXPECT_EQ(ladder_of(scene("slab"), options).size(), 1u);
}

TEST(Ladder, OfASteadyStateVariesTheMeshAlone) {
  const Scene steady = scene("cooled_plate");
  ASSERT_TRUE(steady.heat->time.steady);
  const auto ladder = ladder_of(steady, {});
  EXPECT_EQ(ladder.size(), 3u);
  for (const Rung& rung : ladder) scene("cooled_plate", overrides_of(steady, rung));
  LadderOptions options;
  options.tolerances = {1};
  EXPECT_THROW(ladder_of(steady, options), InputError);
}

TEST(Ladder, ComparesLumpedBlocksWithMeshedOnes) {
  LadderOptions options;
  options.mesh_factors = {1};
  options.tolerances = {0.1};
  options.block_models = {"lumped", "meshed", "auto"};
  const auto ladder = ladder_of(scene("blown_cubes"), options);
  ASSERT_EQ(ladder.size(), 3u);
  EXPECT_EQ(ladder[finest(ladder)].block_model, "meshed");
  for (const Rung& rung : ladder) scene("blown_cubes", overrides_of(scene("blown_cubes"), rung));
}

// What the scene says of some bodies and joints would make rows of other models than they say.
TEST(Ladder, TakesAModelForAllBodiesAndJoints) {
  const std::vector<std::string> of_some{"heat.blocks={model: auto, bodies: {left: lumped}}",
                                         "contact={joints: [{bodies: [left, right], conductance: 5, model: semi_spring}]}"};
  const Scene own = scene("bars_and_joint", of_some);
  LadderOptions options;
  options.mesh_factors = {1};
  options.tolerances = {0.1};
  options.block_models = {"meshed"};
  options.contact_models = {"semi_spring", "overlap"};
  for (const Rung& rung : ladder_of(own, options)) {
    std::vector<std::string> overrides = of_some;
    for (const std::string& override : overrides_of(own, rung)) overrides.push_back(override);
    const Scene varied = scene("bars_and_joint", overrides);
    EXPECT_TRUE(varied.heat->blocks.all_meshed());
    EXPECT_FALSE(varied.heat->joint.rules.at(0).model);
    EXPECT_EQ(varied.heat->joint.model == contact::Model::overlap, rung.contact_model == "overlap");
  }
}

TEST(Ladder, TakesTheScenesOwnStepsUnlessTold) {
  const Scene own = scene("bars_and_joint", {"heat.integrator=explicit_euler", "heat.step=1 s"});
  LadderOptions options;
  options.mesh_factors = {2, 1};
  for (const Rung& rung : ladder_of(own, options)) {
    EXPECT_EQ(rung.integrator, "explicit_euler");
    EXPECT_EQ(overrides_of(own, rung).back(), "heat.integrator=explicit_euler");
  }
  options.integrators = {"implicit"};
  for (const Rung& rung : ladder_of(own, options)) EXPECT_EQ(overrides_of(own, rung).back(), "heat.step=null");
}

TEST(Ladder, EveryRungIsASceneThatReads) {
  const Scene slab = scene("slab");
  for (const Rung& rung : ladder_of(slab, {})) {
    const Scene varied = scene("slab", overrides_of(slab, rung));
    EXPECT_DOUBLE_EQ(varied.bodies[0].mesh_size, rung.mesh_factor * slab.bodies[0].mesh_size);
    EXPECT_DOUBLE_EQ(varied.heat->time.tolerance, rung.tolerance);
  }
}

}  // namespace
}  // namespace scree::accuracy
