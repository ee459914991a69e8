// What a scene's heat asks of its blocks, found before any work is done.

#include <fstream>
#include <map>

#include <gmock/gmock.h>

#include "engine/mesh/make_blocks.h"
#include "engine/packing/packing.h"
#include "tests/scenes/scene_run.h"
#include "tools/run/packing_stage.h"
#include "tools/run/preflight.h"
#include "tools/scene/read_scene.h"

namespace scree::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string still =
    "materials: {rock: {density: 2500, conductivity: 3, specific_heat: 880, friction: 0.5}}\n"
    "bodies:\n"
    "  plate: {box: {size: [1, 1, 0.1], centre: [0, 0, -0.05]}, material: rock, mesh_size: 0.5, fixed: true}\n"
    "  cube: {box: {size: [0.2, 0.2, 0.2], centre: [0, 0, 0.1]}, material: rock, mesh_size: 0.1}\n"
    "heat: {initial: 300, boundaries: [{body: plate, temperature: 400}], until: 1 h}\n"
    "output: {every: 1 h, probes: {p: [0, 0, 0.1]}}\n";
const std::string settling = still + "settle:\n";

// What the scene is refused with before any work; empty: nothing.
std::string refused(const std::string& text, const std::string& override) {
  const Scene scene = read_scene_text(text, ".", {override});
  const auto blocks = mesh::make_blocks<3>(scene.bodies, {});
  try {
    run::check_heat(scene, blocks);
  } catch (const InputError& error) {
    return located(scene, error).what();
  }
  return {};
}

struct Case {
  const char* override;
  const char* place;
  const char* said;
};

TEST(Preflight, FindsWhatTheBlocksCannotGive) {
  const Case cases[] = {
      {"heat.boundaries.0.surface=nope", "scene:5:35: ", "must be a surface of body plate"},
      {"heat.boundaries.0.within={low: [5, 5, 5], high: [6, 6, 6]}", "scene:5:35: ", "must hold at least one node"},
      {"heat.sources=[{body: plate, power: 1, within: {low: [5, 5, 5], high: [6, 6, 6]}}]",
       "--set heat.sources: ", "must hold a part of an element"},
      {"heat.effective_conductivity={low: [5, 5, 5], high: [6, 6, 6]}", "--set heat.effective_conductivity: ",
       "is a window from (5, 5, 5) to (6, 6, 6) m (must hold a part of at least one element)"},
      {"heat.space_order=4", "--set heat.space_order: ", "must have blocks of hexahedra"},
      {"heat.initial={expression: 300 + 1/(z - z), unit: K}", "--set heat.initial: ", "inf K at x ="},
      {"materials.rock.specific_heat={expression: T-301}", "--set materials.rock.specific_heat: ", "is -1 J/kg/K at 300 K"},
      {"materials.rock.conductivity={expression: 299-T}", "--set materials.rock.conductivity: ", "is -1 W/m/K at 300 K"},
      {"output.probes={p: [9, 9, 9]}", "--set output.probes: ", "output.probes.p is [9, 9, 9]"},
  };
  for (const Case& wrong : cases) {
    EXPECT_THAT(refused(still, wrong.override), AllOf(HasSubstr(wrong.said), HasSubstr(wrong.place))) << wrong.override;
  }
  EXPECT_EQ(refused(still, "title=nothing wrong"), "");
}

TEST(Preflight, OfASceneThatSettlesFindsWhatDoesNotDependOnWhereBlocksWillLie) {
  EXPECT_THAT(refused(settling, "heat.boundaries.0.surface=nope"), HasSubstr("must be a surface of body plate"));
  EXPECT_THAT(refused(settling, "heat.boundaries.0.within={low: [5, 5, 5], high: [6, 6, 6]}"),
              HasSubstr("must hold at least one node"));
  EXPECT_THAT(refused(settling, "heat.space_order=4"), HasSubstr("must have blocks of hexahedra"));
  EXPECT_THAT(refused(settling, "heat.initial={from: no_folder}"), HasSubstr("no_folder (must be there)"));
  EXPECT_EQ(refused(settling, "heat.sources=[{body: cube, power: 1, within: {low: [5, 5, 5], high: [6, 6, 6]}}]"), "");
  EXPECT_EQ(refused(settling, "output.probes={p: [0, 0, 9]}"), "");
  EXPECT_EQ(refused(settling, "heat.initial={cube: {expression: 1/(z - z), unit: K}, plate: 300}"), "");
}

// What the command `check` asks beyond that of blocks that lie where they are heated.
std::string refused_placed(const std::vector<std::string>& overrides) {
  const Scene scene = read_scene_text(still, ".", overrides);
  try {
    run::check_placed(scene, packing::unmoved<3>(mesh::make_blocks<3>(scene.bodies, {})));
  } catch (const InputError& error) {
    return located(scene, error).what();
  }
  return {};
}

TEST(Preflight, OfBlocksInTheirPlacesFindsWhatARunIsRefusedWithBeforeItsFirstStep) {
  EXPECT_EQ(refused_placed({}), "");
  EXPECT_THAT(refused_placed({"heat.boundaries.0.temperature={expression: \"t < 1 ? -5 : 300\"}"}), HasSubstr("is -5 K"));
  EXPECT_THAT(refused_placed({"heat.boundaries.0.within={low: [-1, -1, -1], high: [0, 1, 1]}", "heat.blocks.model=lumped"}),
              HasSubstr("must be held as a whole"));
  EXPECT_THAT(refused_placed({"heat.steady=true", "heat.until=null", "output.every=null",
                              "heat.boundaries=[{body: plate, surface: z_low, flux: 3}]"}),
              HasSubstr("must give every block a path"));
  EXPECT_THAT(refused_placed({"heat.integrator=explicit_euler", "heat.step=1e6"}),
              HasSubstr("must be at most the stable step"));
  EXPECT_THAT(refused_placed({"contact.joints=[{bodies: [cube, cube], conductance: 3}]"}),
              HasSubstr("must hold for some contact"));
}

TEST(Preflight, ARunDoesNotWriteOverWhatItReads) {
  const auto folder = fresh_directory("own_inputs");
  std::ofstream(folder / "scene.yaml") << still;
  EXPECT_THAT(refusal_of_file(folder / "scene.yaml", folder), HasSubstr("holds a scene.yaml that no run has left"));
  EXPECT_EQ(contents(folder / "scene.yaml"), still);
  for (const std::string own : {"probes.csv", "report.html", "heat.png", "contacts.pvd", "heat/heat_000042.vtu"}) {
    const auto place = fresh_directory("own_files"), file = place / own;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "somebody's";
    EXPECT_THAT(refusal_of_file(folder / "scene.yaml", place), HasSubstr("holds a " + file.filename().string())) << own;
    EXPECT_EQ(contents(file), "somebody's");
  }
  const auto out = folder / "out";
  ASSERT_EQ(run_file(folder / "scene.yaml", out).exit_status, 0);
  ASSERT_EQ(run_file(out / "scene.yaml", out).exit_status, 0) << "that one a run has left";
  const std::string before = contents(out / "heat/heat_000001.vtu");
  for (const char* from : {"out", "out/heat.pvd", "out/heat/heat_000001.vtu"}) {
    EXPECT_THAT(refusal_of_file(folder / "scene.yaml", out, {"heat.initial={from: " + (folder / from).string() + "}"}),
                HasSubstr("which the run reads"))
        << from;
  }
  EXPECT_EQ(contents(out / "heat/heat_000001.vtu"), before);
  EXPECT_EQ(run_file(folder / "scene.yaml", folder / "more", {"heat.initial={from: " + out.string() + "}"}).exit_status, 0);
}

// In which a window of rest is longer than the one that is asked for.
TEST(Preflight, AFallInWeakGravityMustLeaveTimeToRest) {
  const Scene scene = read_scene_text(settling, ".", {"settle.gravity=[0, 0, -1e-6]", "settle.limit=5 s"});
  const auto blocks = mesh::make_blocks<3>(scene.bodies, {});
  EXPECT_THAT([&] { run::check_fall(scene, blocks); },
              testing::ThrowsMessage<InputError>(HasSubstr("settle.limit is 5 s (must be at least")));
  const Scene longer = read_scene_text(settling, ".", {"settle.gravity=[0, 0, -1e-6]", "settle.limit=1 h"});
  EXPECT_NO_THROW(run::check_fall(longer, blocks));
}

TEST(Preflight, ARunRefusesBeforeAnythingFalls) {
  const auto directory = fresh_directory("preflight");
  EXPECT_THAT(refusal("small_pile", directory, {"heat.boundaries.0.surface=nope"}),
              HasSubstr("must be a surface of body plate"));
  EXPECT_TRUE(std::filesystem::is_empty(directory));
}

// Each of them is found at another stage: in the mesher, in the packing, at the probes, at the joints, in the steady state.
TEST(Preflight, NothingIsLeftOfARunThatIsRefused) {
  const auto folder = fresh_directory("nothing_left");
  std::ofstream(folder / "open.stl") << "solid open\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                        "vertex 0 1 0\nendloop\nendfacet\nendsolid open\n";
  std::ofstream(folder / "broken.h5") << "no packing";
  std::ofstream(folder / "scene.yaml") << still;
  const std::vector<std::vector<std::string>> cases = {
      {"bodies.cube.box=null", "bodies.cube.mesh={file: " + (folder / "open.stl").string() + "}"},
      {"packing=" + (folder / "broken.h5").string()},
      {"output.probes={p: [9, 9, 9]}"},
      {"contact.joints=[{bodies: [cube, cube], conductance: 5}]"},
      {"heat.effective_conductivity={low: [5, 5, 5], high: [6, 6, 6]}"},
      {"heat.boundaries=[]", "heat.steady=true", "heat.until=null", "output.every=null"}};
  for (const auto& overrides : cases) {
    EXPECT_NE(refusal_of_file(folder / "scene.yaml", folder / "deep/out", overrides), "accepted") << overrides[0];
    EXPECT_FALSE(std::filesystem::exists(folder / "deep")) << overrides[0];
  }
}

TEST(Preflight, ARunThatIsRefusedLeavesAnEarlierResultAsItIs) {
  const auto folder = fresh_directory("earlier_left");
  std::ofstream(folder / "scene.yaml") << still;
  ASSERT_EQ(run_file(folder / "scene.yaml", folder / "out").exit_status, 0);
  const auto files = [&] {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out"))
      if (entry.is_regular_file()) bytes[entry.path().string()] = contents(entry.path());
    return bytes;
  };
  const auto before = files();
  EXPECT_NE(refusal_of_file(folder / "scene.yaml", folder / "out", {"output.probes={p: [9, 9, 9]}"}), "accepted");
  EXPECT_NE(
      refusal_of_file(folder / "scene.yaml", folder / "out", {"bodies.cube.mesh_size=0.05", "heat.boundaries.0.surface=nope"}),
      "accepted");
  EXPECT_NE(refusal_of_file(folder / "scene.yaml", folder / "out",
                            {"output.probes={p: {point: [0, 0, 0.1], exact: {expression: 300/x, unit: K}}}"}),
            "accepted");
  EXPECT_EQ(files(), before);
}

TEST(ExactValuesOfProbes, AreAskedForBeforeAnyWork) {
  EXPECT_EQ(refused(still, "output.probes.p={point: [0, 0, 0.1], exact: 300}"), "");
  EXPECT_THAT(refused(still, "output.probes.p={point: [0, 0, 0.1], exact: {expression: log(t), unit: K}}"),
              HasSubstr("output.probes.p.exact"));
  EXPECT_THROW(
      read_scene_text(still, ".", {"output.probes.p={point: [0, 0, 0.1], exact: {table: [[50 s, 300], [60 s, 300]]}}"}),
      InputError);
}

}  // namespace
}  // namespace scree::test
