#include "tools/scene/read_scene.h"

#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>

#include "tests/scene/scene_text.h"

namespace scree {

namespace {

using test::scene_of;
using test::values_of;
using test::whole_scene;
using testing::HasSubstr;

std::vector<double> initial_temperatures(const Scene& scene) {
  std::vector<double> values;
  for (const Function& function : scene.heat->initial_temperature) values.push_back(function.constant().value());
  return values;
}

TEST(ReadScene, FillsTheStructsInSi) {
  const Scene scene = scene_of(whole_scene);
  EXPECT_EQ(scene.title, "whole");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[MaterialId{0}].conductivity->value.constant(), 3.1);
  EXPECT_FALSE(scene.materials[MaterialId{1}].conductivity.has_value());
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].name, "plate");
  EXPECT_EQ(scene.bodies[0].mesh_size, 0.05);
  EXPECT_TRUE(scene.bodies[0].fixed);
  EXPECT_EQ(std::get<mesh::Sphere>(scene.bodies[1].shape).diameter, 0.4);
  EXPECT_EQ(std::get<mesh::AtPoses>(scene.bodies[1].arrangement).poses.front().translation, Eigen::Vector3d(0, 0, 0.5));
  ASSERT_TRUE(scene.settle && scene.contact && scene.heat);
  EXPECT_EQ(initial_temperatures(scene), std::vector<double>(2, 298.15));
  ASSERT_EQ(scene.heat->boundaries.size(), 3u);
  EXPECT_EQ(std::get<thermal::FixedTemperature>(scene.heat->boundaries[0].condition).temperature.constant(), 373.15);
  EXPECT_EQ(std::get<thermal::HeatFlux>(scene.heat->boundaries[1].condition).flux.constant(), 5000);
  EXPECT_EQ(scene.heat->boundaries[1].region.body, BodyId{1});
  EXPECT_EQ(scene.heat->boundaries[2].name, "flow of block");
  EXPECT_EQ(scene.heat->time.until, 43200);
  EXPECT_EQ(scene.heat->time.output_every, 600);
  EXPECT_EQ(scene.probes[1].point.z(), 0.44);
}

// The table takes its defaults from the structs; an empty section must therefore give the struct as it is.
TEST(ReadScene, EmptySectionsAreTheDefaultsOfTheStructs) {
  Scene scene = scene_of(whole_scene);
  const std::string before = values_of(scene);
  scene.settle = SettleStage{};
  scene.contact = contact::ContactOptions{};
  scene.heat->joint = thermal::JointOptions{};
  scene.heat->time.tolerance = thermal::TimeOptions{}.tolerance;
  scene.heat->time.integrator = thermal::TimeOptions{}.integrator;
  scene.materials[MaterialId{1}] = Material{.name = "ice", .density = 917, .conductivity = {}, .specific_heat = {}};
  scene.bodies[1].velocity = mesh::BodySpec{}.velocity;
  EXPECT_EQ(values_of(scene), before);
}

TEST(ReadScene, TheEffectiveSceneIsTheSameScene) {
  const char* const scenes[] = {
      whole_scene,
      "dimension: 2\nmaterials: {a: {}}\nbodies: {b: {material: a, mesh_size: 1 mm, box: {size: [1, 2], centre: [0, 3 cm], "
      "rotation: "
      "{angle: 30 deg}}}}\n",
      "title: 'quotes \" and: colons # too'\nmaterials: {a: {density: 2.5 g/cm3}}\nbodies: {b: {material: a, mesh_size: 1, "
      "sphere: "
      "{diameter: 1}, random: {count: 5, low: [0, 0, 0], high: [9, 9, 9]}}, c: {material: a, mesh_size: 1, sphere: {diameter: "
      "1}, "
      "at: [{position: [1, 2, 3]}, {position: [4, 5, 6], rotation: [0, 0, 0, 1]}]}}\nsettle:\n",
  };
  for (const char* text : scenes) {
    const Scene scene = scene_of(text);
    const Scene again = scene_of(scene.effective);
    EXPECT_EQ(values_of(again), values_of(scene));
    EXPECT_EQ(again.effective, scene.effective);
  }
}

// A run is told from another by that text: `scree resume` reads its scene.yaml again.
TEST(ReadScene, TheEffectiveSceneReadAgainIsTheSameTextWhateverIsLeftOut) {
  for (const char* left_out : {"title", "output", "output.every", "output.probes", "heat.boundaries", "settle"}) {
    for (const char* also : {"output.frames_every=20 min", "output.every=20 min", "heat.tolerance=1 K"}) {
      const Scene scene = scene_of(whole_scene, {std::string(left_out) + "=null", also});
      EXPECT_EQ(scene_of(scene.effective).effective, scene.effective) << left_out << " and " << also;
    }
  }
}

TEST(ReadScene, TheEffectiveSceneShowsEveryDefault) {
  const std::string text = scene_of(whole_scene).effective;
  for (const char* line :
       {"dimension: 3", "friction: 0.6", "blocks: whole", "fixed: false", "limit: 10 s", "gravity: [0, 0, -9.81]",
        "stiffness_factor: 10", "form: consistent", "tolerance: 0.1 K", "integrator: automatic", "reach: 0 m"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
}

TEST(ReadScene, WithoutIntervalsThereAreSixtyRowsAndTwelveFrames) {
  const Scene scene = scene_of(whole_scene, {"output=null"});
  EXPECT_EQ(scene.heat->time.output_every, 720);
  EXPECT_EQ(scene.frames_every, 3600);
  EXPECT_THAT(scene.effective, HasSubstr("every: 720 s"));
  EXPECT_THAT(scene.effective, HasSubstr("frames_every: 3600 s"));
  EXPECT_EQ(values_of(scene_of(scene.effective)), values_of(scene));
}

TEST(ReadScene, TheIntervalOfRowsIsThatOfFramesIfThatAloneIsGivenAndTheOtherWayRound) {
  const Scene by_frames = scene_of(whole_scene, {"output.every=null", "output.frames_every=7 min"});
  EXPECT_EQ(by_frames.heat->time.output_every, 420);
  EXPECT_EQ(by_frames.frames_every, 420);
  const Scene by_rows = scene_of(whole_scene, {"output.every=7 min"});
  EXPECT_EQ(by_rows.heat->time.output_every, 420);
  EXPECT_EQ(by_rows.frames_every, 0);  // every row
}

TEST(ReadScene, SectionsThatAreAbsentAreNotModelled) {
  const Scene scene =
      scene_of("materials: {a: {}}\nbodies: {b: {material: a, mesh_size: 1, sphere: {diameter: 1, centre: [0, 0, 0]}}}\n");
  EXPECT_FALSE(scene.settle || scene.packing || scene.contact || scene.heat);
  EXPECT_TRUE(scene.probes.empty());
  EXPECT_THAT(scene.effective, testing::Not(HasSubstr("contact")));
}

TEST(ReadScene, RotationsAreRotations) {
  const auto pose = [](const std::string& rotation) {
    const Scene scene = scene_of(
        "materials: {a: {}}\nbodies: {b: {material: a, mesh_size: 1, box: {size: [1, 1, 1], centre: [0, "
        "0, 0], rotation: " +
        rotation + "}}}\n");
    return std::get<mesh::AtPoses>(scene.bodies[0].arrangement).poses.front();
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_TRUE((pose("{axis: [0, 0, 7], angle: 90 deg}") * x).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_TRUE((pose("{axis: [0, 1, 0], angle: 3.141592653589793}") * x).isApprox(-x, 1e-15));
  for (const char* axis : {"[0, 0, 1e-200]", "[0, 0, 1e200]"}) {
    EXPECT_TRUE((pose(std::string("{axis: ") + axis + ", angle: 90 deg}") * x).isApprox(Eigen::Vector3d::UnitY(), 1e-15))
        << axis;
  }
  EXPECT_TRUE((pose("[0.7071, 0, 0, 0.7071]") * x).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
  EXPECT_NEAR(pose("[0.7071, 0, 0, 0.7071]").rotation.norm(), 1, 1e-15);
}

TEST(ReadScene, OverridesReachEverywhere) {
  const Scene scene =
      scene_of(whole_scene, {"bodies.block.mesh_size=8 cm", "heat.boundaries[0].temperature=50 degC", "output.probes.low.2=0.1",
                             "settle=null", "heat.initial={plate: 300, block: 310}"});
  EXPECT_EQ(scene.bodies[1].mesh_size, 0.08);
  EXPECT_EQ(std::get<thermal::FixedTemperature>(scene.heat->boundaries[0].condition).temperature.constant(), 323.15);
  EXPECT_EQ(scene.probes[0].point.z(), 0.1);
  EXPECT_FALSE(scene.settle);
  EXPECT_EQ(initial_temperatures(scene), (std::vector<double>{300, 310}));
}

TEST(ReadScene, MeshFilesStandBesideTheScene) {
  const Scene first = scene_of(whole_scene);
  const auto folder = first.file.parent_path();
  std::ofstream(folder / "rock.stl") << "solid";
  const std::string yaml =
      "materials: {a: {}}\nbodies: {b: {material: a, mesh_size: 1, mesh: {file: rock.stl, scale: 1 mm, position: [1, 2, "
      "3]}}}\n";
  const Scene scene = scene_of(yaml);
  const auto& shape = std::get<mesh::MeshFile>(scene.bodies[0].shape);
  EXPECT_EQ(shape.path, folder / "rock.stl");
  EXPECT_EQ(shape.scale, 1e-3);
  EXPECT_EQ(values_of(scene_of(scene.effective)), values_of(scene));
}

// Whatever stands in a file, reading it ends with a scene or with an InputError.
TEST(ReadScene, DamagedFilesNeverCrash) {
  const std::string text = scene_of(whole_scene).effective;
  for (std::size_t length = 0; length < text.size(); length += 13) test::wrong_with(text.substr(0, length));
  for (std::size_t at = 0; at < text.size(); at += 89) {
    for (const char c : {'[', '}', ':', '\n', '*', '\0', '"'}) {
      std::string damaged = text;
      damaged[at] = c;
      test::wrong_with(damaged);
    }
  }
}

TEST(ReadScene, ASeedStartsFreeBodiesAsideAcrossGravityAndNeverFarther) {
  const auto place = [](const Scene& scene, std::size_t body) {
    return std::get<mesh::AtPoses>(scene.bodies[body].arrangement).poses.front().translation;
  };
  const Scene placed = scene_of(whole_scene);
  const Scene one = scene_of(whole_scene, {"settle.seed=1"});
  const Scene two = scene_of(whole_scene, {"settle.seed=2"});
  EXPECT_EQ(place(one, 0), place(placed, 0)) << "a fixed body";
  EXPECT_NE(place(one, 1), place(two, 1));
  EXPECT_EQ(place(one, 1), place(scene_of(whole_scene, {"settle.seed=1"}), 1));
  const Eigen::Vector3d way = place(one, 1) - place(placed, 1);
  EXPECT_EQ(way.z(), 0);
  EXPECT_GT(way.norm(), 0);
  EXPECT_LE(way.cwiseAbs().maxCoeff(), 1e-3 * one.bodies[1].mesh_size * (1 + 1e-9));
  const Scene coarse = scene_of(whole_scene, {"settle.seed=1", "bodies.block.mesh_size=50 m"});
  const Scene as_large = scene_of(whole_scene, {"settle.seed=1", "bodies.block.mesh_size=40 cm"});
  EXPECT_EQ(place(coarse, 1), place(as_large, 1)) << "a mesh size beyond the body is the body's";
}

}  // namespace

}  // namespace scree
