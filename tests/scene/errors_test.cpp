#include <gmock/gmock.h>

#include "tests/scene/scene_text.h"

namespace scree {

namespace {

using test::whole_scene;
using test::wrong_with;

const std::string materials = "materials: {ore: {density: 1, conductivity: 1, specific_heat: 1}}\n";

// One body on line 2 in the middle of a scene.
std::string with_body(const std::string& body) {
  return materials + "bodies: {b: {" + body + "}}\n";
}

const std::string good_body = "material: ore, mesh_size: 1, sphere: {diameter: 1, centre: [0, 0, 0]}";

TEST(SceneErrors, TheSmallSceneOfTheseTestsIsAccepted) {
  EXPECT_EQ(wrong_with(with_body(good_body)), "accepted");
}

TEST(SceneErrors, AProbeIsNotCalledLikeTheFirstColumn) {
  const std::string heat = with_body(good_body) + "heat: {initial: 300, until: 1}\n";
  EXPECT_THAT(wrong_with(heat + "output: {every: 1, probes: {time: [0, 0, 0]}}\n"),
              testing::HasSubstr("output.probes.time is the first column of probes.csv (must be another name)"));
}

TEST(SceneErrors, AllAreListedInTheOrderOfTheFile) {
  EXPECT_EQ(wrong_with("materials:\n"
                       "  ore: {desnity: 2500, conductivity: -2.0}\n"
                       "bodies:\n"
                       "  b: {material: oer, mesh_size: 3 kg, blocks: per_elemnt, sphere: {diameter: 1, centre: [0, 0]}}\n"
                       "heat: {initial: 25 C, until: 12 m}\n"),
            "s.yaml:2:9: materials.ore.desnity is unknown (no key of materials.ore). Did you mean density?\n"
            "s.yaml:2:38: materials.ore.conductivity is -2.0 (must be positive, W/m/K). Did you mean 2.0?\n"
            "s.yaml:4:17: bodies.b.material is oer (must be a material of this scene). Did you mean ore?\n"
            "s.yaml:4:33: bodies.b.mesh_size is 3 kg (must be positive, m; kg is no unit of length). Write it in m or another "
            "unit of length\n"
            "s.yaml:4:47: bodies.b.blocks is per_elemnt (must be one of whole, per_element). Did you mean per_element?\n"
            "s.yaml:4:89: bodies.b.sphere.centre is a list (must be a list of 3, each a length, m; it has 2)\n"
            "s.yaml:5:17: heat.initial is 25 C (must be not negative, K; C is no unit of temperature). Did you mean 25 degC?\n"
            "s.yaml:5:30: heat.until is 12 m (must be positive, s; m is no unit of time). Did you mean 12 min?");
}

TEST(SceneErrors, AnEmptySceneSaysWhatItNeeds) {
  EXPECT_EQ(wrong_with(""),
            "s.yaml:1:1: materials is missing (must be a map of names, at least 1)\n"
            "s.yaml:1:1: bodies is missing (must be a map of names, at least 1)");
}

TEST(SceneErrors, ABodyHasOneShapeAndOneArrangement) {
  EXPECT_EQ(wrong_with(with_body("material: ore, mesh_size: 1")),
            "s.yaml:2:13: bodies.b is without a shape (must have exactly one of box, sphere, cylinder, mesh)");
  EXPECT_EQ(
      wrong_with(with_body(good_body + ", cylinder: {diameter: 1, height: 1, centre: [0, 0, 0]}")),
      "s.yaml:2:85: bodies.b.cylinder is given beside sphere (must have exactly one of box, sphere, cylinder, mesh). Keep one "
      "of them");
  EXPECT_EQ(wrong_with(with_body(
                "material: ore, mesh_size: 1, sphere: {diameter: 1, centre: [0, 0, 0]}, at: [{position: [0, 0, 0]}]")),
            "s.yaml:2:65: bodies.b.sphere.centre is without use (of use only without bodies.b.at). Take it out");
  EXPECT_EQ(
      wrong_with(with_body("material: ore, mesh_size: 1, sphere: {diameter: 1}, at: [{position: [0, 0, 0]}], random: {count: "
                           "1, low: [0, 0, 0], high: [1, 1, 1]}")),
      "s.yaml:2:95: bodies.b.random is given beside at (must have at most one of lattice, random, at). Keep one of them");
}

TEST(SceneErrors, PlacementsMustMakeSense) {
  EXPECT_EQ(
      wrong_with(with_body("material: ore, mesh_size: 1, sphere: {diameter: 1}, random: {count: 1, low: [0, 0, 2], high: [1, "
                           "1, 1]}")),
      "s.yaml:2:107: bodies.b.random.high is 1 in z (must be above low, which is 2). Swap low and high");
  EXPECT_EQ(
      wrong_with(with_body("material: ore, mesh_size: 1, sphere: {diameter: 1}, lattice: {count: [1000, 1000, 1000], spacing: "
                           "[1, 1, 1], centre: [0, 0, 0]}")),
      "s.yaml:2:83: bodies.b.lattice.count is 1e+09 copies (must be at most 10 million in all)");
  const std::string box = "material: ore, mesh_size: 1, box: {size: [1, 1, 1], centre: [0, 0, 0], rotation: ";
  EXPECT_EQ(wrong_with(with_body(box + "{axis: [0, 0, 0], angle: 1}}")),
            "s.yaml:2:102: bodies.b.box.rotation.axis is zero (must have a direction)");
  EXPECT_EQ(wrong_with(with_body(box + "[1, 1, 0, 0]}")),
            "s.yaml:2:95: bodies.b.box.rotation is no rotation (a quaternion [w, x, y, z] must have length 1)");
  EXPECT_EQ(wrong_with(with_body("material: ore, mesh_size: 1, mesh: {file: none.stl, position: [0, 0, 0]}")),
            "s.yaml:2:56: bodies.b.mesh.file is none.stl (must be a file that exists)");
}

TEST(SceneErrors, MotionAndCylindersAreForThreeDimensions) {
  EXPECT_EQ(
      wrong_with("dimension: 2\n" + materials +
                 "bodies: {b: {material: ore, mesh_size: 1, cylinder: {diameter: 1, height: 1, centre: [0, 0]}}}\nsettle: "
                 "{gravity: [0, -9.81]}\n"),
      "s.yaml:3:43: bodies.b.cylinder is without use (of use only with dimension: 3). Take it out\n"
      "s.yaml:4:1: settle is without use (of use only with dimension: 3). Take it out");
  EXPECT_EQ(
      wrong_with("dimension: 2\n" + materials +
                 "bodies: {b: {material: ore, mesh_size: 1, box: {size: [1, 1], centre: [0, 0], rotation: [0, 1, 0, 0]}}}\n"),
      "s.yaml:3:89: bodies.b.box.rotation is out of the plane (in 2-D, x and y of the quaternion must be 0)");
}

TEST(SceneErrors, KeysWithoutUseAreRefused) {
  EXPECT_EQ(wrong_with(with_body(good_body) + "contact: {}\noutput: {every: 1}\n"),
            "s.yaml:3:1: contact is without use (of use only with heat). Take it out\n"
            "s.yaml:4:1: output is without use (of use only with heat). Take it out");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.step=1 s"}),
            "--set heat.step: heat.step is without use (of use only with heat.integrator: explicit_euler). Take it out");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.step=1 s", "heat.integrator=explicit_euler"}), "accepted");
  EXPECT_EQ(
      wrong_with(whole_scene, {"bodies.plate.velocity=[1, 0, 0]"}),
      "--set bodies.plate.velocity: bodies.plate.velocity is without use (of use only without bodies.plate.fixed: true). Take "
      "it out");
  EXPECT_EQ(wrong_with(with_body(good_body) + "settle: {}\npacking: s.yaml\n"),
            "s.yaml:4:1: packing is given beside settle (must have at most one of packing, settle). Keep one of them");
}

TEST(SceneErrors, ExplicitStepsAreRefusedForWhatChangesAndSayWhat) {
  const std::string curve = "materials.ore.conductivity={table: [[0 degC, 2], [100 degC, 3]]}";
  const std::string radiates = "heat.boundaries[1]={body: block, radiation: {emissivity: 0.5, surroundings: 280}}";
  const std::string warms = "heat.boundaries[0].temperature={expression: 300 + t}";
  const std::string cools =
      "heat.boundaries[1]={body: block, convection: {coefficient: {expression: 1 + t}, surroundings: 280}}";
  const auto refusal = [](const std::string& steps, const std::string& change) {
    return wrong_with(whole_scene, {change, "heat.integrator=" + steps});
  };
  using testing::HasSubstr;
  const std::string begin = "heat.integrator is explicit_euler (does only what does not change: ";
  EXPECT_THAT(refusal("explicit_euler", curve),
              HasSubstr(begin + "properties of ore depend on temperature). Use the implicit"));
  EXPECT_THAT(refusal("explicit_euler", radiates), HasSubstr(" is not linear in temperature). Use the implicit"));
  EXPECT_THAT(refusal("explicit_euler", cools), HasSubstr(begin + "the coefficient of "));
  EXPECT_EQ(refusal("explicit_euler", warms), "accepted");
  for (const std::string& change : {curve, radiates, warms, cools}) {
    EXPECT_EQ(refusal("stabilised_explicit", change), "accepted");
  }
  EXPECT_EQ(refusal("automatic", radiates), "accepted");
  EXPECT_EQ(wrong_with(whole_scene, {radiates, "heat.steady=true", "heat.until=null"}).find("heat.integrator"),
            std::string::npos);
}

TEST(SceneErrors, MaterialsNeedWhatIsModelled) {
  const std::string bare = "materials: {ore: {}}\nbodies: {b: {" + good_body + "}}\n";
  EXPECT_EQ(wrong_with(bare), "accepted");
  EXPECT_EQ(wrong_with(bare + "settle: {}\n"), "s.yaml:1:18: materials.ore.density is missing (body b is free to fall)");
  EXPECT_EQ(wrong_with(bare + "settle: {}\n", {"bodies.b.fixed=true"}), "accepted");
  EXPECT_EQ(wrong_with(bare + "heat: {initial: 300, until: 1}\noutput: {every: 1}\n"),
            "s.yaml:1:18: materials.ore.conductivity is missing (heat is modelled in body b)\n"
            "s.yaml:1:18: materials.ore.density is missing (heat is modelled in body b)\n"
            "s.yaml:1:18: materials.ore.specific_heat is missing (heat is modelled in body b)");
  const std::string steady = bare + "heat: {initial: 300, steady: true}\n";
  EXPECT_EQ(wrong_with(steady), "s.yaml:1:18: materials.ore.conductivity is missing (heat is modelled in body b)");
  EXPECT_EQ(wrong_with(steady, {"materials.ore.conductivity=3"}), "accepted");
  EXPECT_EQ(wrong_with(steady + "settle: {}\n", {"materials.ore.conductivity=3"}),
            "s.yaml:1:18: materials.ore.density is missing (body b is free to fall)");
}

TEST(SceneErrors, AMaterialThatOnlyAnOverrideNamesIsAMisspeltOneUnlessABodyTakesIt) {
  EXPECT_EQ(wrong_with(whole_scene, {"materials.oer.conductivity=2"}),
            "--set materials.oer.conductivity: materials.oer is new (must be a material of this scene). Did you mean ore?");
  const std::vector<std::string> taken{"materials.rock={density: 2700, conductivity: 2, specific_heat: 800}",
                                       "bodies.block.material=rock"};
  EXPECT_EQ(wrong_with(whole_scene, taken), "accepted");
  EXPECT_EQ(wrong_with(whole_scene, {"materials.ice.density=900"}), "accepted") << "the scene itself has it";
}

TEST(SceneErrors, HeatNamesBodiesOfTheScene) {
  EXPECT_EQ(
      wrong_with(whole_scene, {"heat.boundaries[0].body=plat", "heat.sources[0].body=rock"}),
      "--set heat.boundaries[0].body: heat.boundaries[0].body is plat (must be a body of this scene). Did you mean plate?\n"
      "--set heat.sources[0].body: heat.sources[0].body is rock (must be a body of this scene). Did you mean block?");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.initial={plate: 300, blok: 300}"}),
            "--set heat.initial: heat.initial.blok is unknown (must be a body of this scene). Did you mean block?\n"
            "--set heat.initial: heat.initial is without block (every body must have a temperature)");
  EXPECT_EQ(
      wrong_with(whole_scene, {"heat.boundaries[0].name=a", "heat.sources[0].name=a"}),
      "--set heat.sources[0].name: heat.sources[0].name is a (must differ from the names of other boundaries and sources)");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.boundaries[1].within.low=[2, 0, 0]"}),
            "s.yaml:21:67: heat.boundaries[1].within.high is 1 in x (must be at least low, which is 2). Swap low and high");
  EXPECT_EQ(
      wrong_with(whole_scene, {"heat.boundaries[0].temperature=-1"}),
      "--set heat.boundaries[0].temperature: heat.boundaries[0].temperature is -1 (must be not negative, K). Did you mean 1?");
}

TEST(SceneErrors, BlocksAreLumpedByKnownModelsInBodiesOfTheScene) {
  EXPECT_EQ(wrong_with(whole_scene, {"heat.blocks={model: lumpd}"}),
            "--set heat.blocks: heat.blocks.model is lumpd (must be one of meshed, lumped, auto). Did you mean lumped?");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.blocks={model: lumped, largest_biot: 0.1}"}),
            "--set heat.blocks: heat.blocks.largest_biot is 0.1 (decides nothing where no block is auto). Take it out, or set "
            "heat.blocks.model to auto");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.blocks=auto"}), "--set heat.blocks: heat.blocks is auto (must be a map of keys)")
      << "and nothing of what is in it";
  EXPECT_EQ(wrong_with(whole_scene, {"heat=yes", "materials.ore.conductivity={expression: 1000/T}"}),
            "--set heat: heat is yes (must be a map of keys)")
      << "likewise";
  EXPECT_EQ(wrong_with(whole_scene, {"heat.blocks={model: auto, largest_biot: -0.1}"}),
            "--set heat.blocks: heat.blocks.largest_biot is -0.1 (must be not negative). Did you mean 0.1?");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.blocks={bodies: {blok: lumped}}"}),
            "--set heat.blocks: heat.blocks.bodies.blok is unknown (must be a body of this scene). Did you mean block?");
  EXPECT_EQ(
      wrong_with(whole_scene,
                 {"heat.blocks={bodies: {block: auto}}", "heat.effective_conductivity={low: [0, 0, 0], high: [1, 1, 1]}"}),
      "--set heat.blocks: heat.blocks is lumped or auto (must be meshed for heat.effective_conductivity). The flux inside "
      "the blocks is what it measures: take heat.blocks out");
}

TEST(SceneErrors, NumbersMustBeFiniteAndFit) {
  EXPECT_EQ(wrong_with(whole_scene, {"bodies.block.mesh_size=.nan"}),
            "--set bodies.block.mesh_size: bodies.block.mesh_size is .nan (must be positive, m; not a number, with or without "
            "a unit)");
  EXPECT_EQ(wrong_with(whole_scene, {"heat.until=inf"}),
            "--set heat.until: heat.until is inf (must be positive, s; not a number, with or without a unit)");
  EXPECT_EQ(
      wrong_with(whole_scene, {"heat.until=1e400"}),
      "--set heat.until: heat.until is 1e400 (must be positive, s; too large or too small for a number in double precision)");
  EXPECT_EQ(
      wrong_with(whole_scene, {"settle.gravity=[0, 0, 0]"}),
      "--set settle.gravity: settle.gravity is zero (nothing falls without it). Leave settle out to keep the bodies where they "
      "are");
}

TEST(SceneErrors, AFallOfMoreStepsThanAnyoneWaitsForIsRefused) {
  EXPECT_EQ(wrong_with(whole_scene, {"settle.limit=2 s", "settle.step=1e-10 s"}),
            "--set settle.step: settle.step is 1e-10 s (must be at least 2e-09 s, for 1e+09 steps to settle.limit)");
}

TEST(SceneErrors, MoreRowsThanAnyoneWaitsForAreRefused) {
  EXPECT_EQ(wrong_with(whole_scene, {"heat.until=1 h", "output.every=1e-300 s"}),
            "--set output.every: output.every is 1e-300 s (must be at least 3.6e-06 s, for 1e+09 rows to heat.until)");
}

TEST(SceneErrors, AFactorisationOfFourthOrderStepsIsWithoutUse) {
  EXPECT_THAT(wrong_with(whole_scene, {"heat.space_order=4", "heat.solver=cholesky"}),
              testing::HasSubstr("heat.solver is without use (of use only without heat.space_order: 4)"));
}

TEST(SceneErrors, AFallMustLeaveTimeToLetGoAndToRest) {
  EXPECT_EQ(wrong_with(whole_scene, {"settle.limit=2 s", "settle.rest_window=3 s"}),
            "--set settle.limit: settle.limit is 2 s (must be at least settle.rest_window, 3 s: no pile is at rest before)");
  EXPECT_EQ(wrong_with(whole_scene, {"settle.limit=2 s", "settle.release_time=3 s"}),
            "--set settle.limit: settle.limit is 2 s (must be at least settle.release_time, 3 s: no pile is at rest before)");
}

TEST(SceneErrors, AFallThatNothingCouldDoIsRefused) {
  EXPECT_EQ(wrong_with(whole_scene, {"settle.gravity=[0, 0, -1e200]"}),
            "--set settle.gravity: settle.gravity[2] is -1e200 (must be at least -100000000 and at most 100000000, m/s2)");
  EXPECT_EQ(
      wrong_with(whole_scene, {"bodies.block.velocity=[1e200, 0, 0]"}),
      "--set bodies.block.velocity: bodies.block.velocity[0] is 1e200 (must be at least -1000000 and at most 1000000, m/s)");
}

TEST(SceneErrors, OverridesAreCheckedWithTheRest) {
  EXPECT_EQ(wrong_with(whole_scene, {"settle.limit=-1", "settle.limti=1", "oops"}),
            "--set oops: oops is not understood (must be key.path=value)\n"
            "--set settle.limit: settle.limit is -1 (must be positive, s). Did you mean 1?\n"
            "--set settle.limti: settle.limti is unknown (no key of settle). Did you mean limit?");
}

}  // namespace

}  // namespace scree
