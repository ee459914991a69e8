#include "tools/scene/doctor.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "engine/mesh/make_blocks.h"
#include "tests/scene/scene_text.h"

namespace scree {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <int dim = 3>
CheckReport report_of(const std::string& yaml) {
  const Scene scene = test::scene_of(yaml);
  return check_scene(scene, mesh::make_blocks<dim>(scene.bodies));
}

const std::string heat = "heat: {initial: 300, until: 1}\noutput: {every: 1, probes: {p: [0, 0, 0.5]}}\n";

// Unit cubes of one material with their centres at given places; those listed first are fixed.
std::string cubes(const std::vector<std::string>& fixed, const std::vector<std::string>& free) {
  std::string text = "materials: {a: {density: 1, conductivity: 1, specific_heat: 1}}\nbodies:\n";
  int number = 0;
  const auto add = [&](const std::string& centre, bool is_fixed) {
    text += fmt::format("  c{}: {{box: {{size: [1, 1, 1], centre: {}}}, material: a, mesh_size: 1, fixed: {}}}\n", number++,
                        centre, is_fixed);
  };
  for (const auto& centre : fixed) add(centre, true);
  for (const auto& centre : free) add(centre, false);
  return text;
}

TEST(Doctor, ASoundSceneIsNotSuspected) {
  const CheckReport report = report_of(cubes({"[0, 0, 0]"}, {"[0, 0, 1.5]"}) + "settle:\n");
  EXPECT_THAT(report.suspicious, IsEmpty());
  EXPECT_THAT(to_text(report), HasSubstr("nothing is suspicious"));
}

TEST(Doctor, CountsAddUp) {
  const Scene scene = test::scene_of(cubes({"[0, 0, 0]"}, {"[0, 0, 1.5]"}), {"bodies.c1.blocks=per_element"});
  const auto blocks = mesh::make_blocks<3>(scene.bodies);
  const CheckReport report = check_scene(scene, blocks);
  ASSERT_EQ(report.bodies.size(), 2u);
  EXPECT_EQ(report.bodies[0].blocks, 1u);
  EXPECT_EQ(report.bodies[1].blocks, report.bodies[1].elements);
  EXPECT_EQ(report.bodies[1].nodes, 4 * report.bodies[1].elements);
  EXPECT_EQ(report.bodies[0].nodes + report.bodies[1].nodes, blocks.nodes.size());
  EXPECT_EQ(report.bodies[0].elements + report.bodies[1].elements, blocks.elements.size());
}

TEST(Doctor, TellsWhatIsModelledAndWhyNot) {
  const auto modelled = [](const std::string& yaml) {
    std::vector<std::string> names;
    for (const Model& model : models_of(test::scene_of(yaml))) {
      if (model.modelled) names.push_back(model.name);
      EXPECT_FALSE(model.reason.empty());
    }
    return names;
  };
  EXPECT_THAT(modelled(test::whole_scene),
              ElementsAre("motion", "conduction in blocks", "heat through contacts", "boundaries", "sources"));
  EXPECT_THAT(modelled(cubes({}, {"[0, 0, 0]"}) + heat), ElementsAre("conduction in blocks", "heat through contacts"));
  EXPECT_THAT(modelled(cubes({}, {"[0, 0, 0]"})), IsEmpty());
}

TEST(Doctor, FindsBodiesThatOverlap) {
  EXPECT_THAT(report_of(cubes({"[0, 0, 0]"}, {"[0.2, 0.1, 0.9]"}) + "settle:\n").suspicious,
              ElementsAre("block 0 of body c0 and block 1 of body c1 overlap by 0.1 m before anything moves"));
  EXPECT_THAT(report_of(cubes({"[0, 0, 0]"}, {"[0.2, 0.1, 1]"}) + "settle:\n").suspicious, IsEmpty());
}

// The walls of a box may; what is heated is there twice.
TEST(Doctor, FindsFixedBodiesThatOverlapWhereThereIsHeat) {
  const auto both = cubes({"[0, 0, 0]", "[0.2, 0.1, 0.9]"}, {});
  const std::string overlap = "block 0 of body c0 and block 1 of body c1 overlap by 0.1 m before anything moves";
  EXPECT_THAT(report_of(both + heat).suspicious, testing::Contains(overlap));
  const auto walls = cubes({"[0, 0, 0]", "[0.2, 0.1, 0.9]"}, {"[0, 0, 3]"});
  EXPECT_THAT(report_of(walls + "settle:\n").suspicious, IsEmpty());
  EXPECT_THAT(report_of(walls + heat + "settle:\n").suspicious, testing::Contains(overlap));
}

TEST(Doctor, FindsBodiesThatOverlapInThePlane) {
  const auto squares = [](const std::string& second) {
    return "dimension: 2\nmaterials: {a: {density: 1, conductivity: 1, specific_heat: 1}}\nbodies:\n"
           "  c0: {box: {size: [1, 1], centre: [0, 0]}, material: a, mesh_size: 0.5}\n"
           "  c1: {box: {size: [1, 1], centre: " +
           second + "}, material: a, mesh_size: 0.5}\nheat: {initial: 300, until: 1}\noutput: {every: 1}\n";
  };
  EXPECT_THAT(report_of<2>(squares("[0.9, 0.3]")).suspicious,
              testing::Contains("block 0 of body c0 and block 1 of body c1 overlap before anything moves"));
  EXPECT_THAT(report_of<2>(squares("[1, 0.3]")).suspicious, IsEmpty());
  EXPECT_THAT(report_of<2>(squares("[0, 0]")).suspicious,
              testing::Contains("block 0 of body c0 and block 1 of body c1 overlap before anything moves"))
      << "one in the other's place";
  const auto copies = [](const std::string& second) {
    return "dimension: 2\nmaterials: {a: {density: 1, conductivity: 1, specific_heat: 1}}\nbodies:\n"
           "  c: {box: {size: [1, 1]}, at: [{position: [0, 0]}, {position: " +
           second +
           "}], material: a, mesh_size: 0.5, blocks: per_element}\nheat: {initial: 300, until: 1}\noutput: {every: 1}\n";
  };
  EXPECT_THAT(report_of<2>(copies("[0.9, 0.3]")).suspicious, testing::Contains(testing::HasSubstr("of body c overlap")));
  EXPECT_THAT(report_of<2>(copies("[1, 0.3]")).suspicious, IsEmpty());
}

TEST(Doctor, FindsWhatNothingCanStop) {
  EXPECT_THAT(report_of(cubes({"[0, 0, 0]"}, {"[3, 0, 1.5]"}) + "settle:\n").suspicious,
              ElementsAre("nothing fixed lies below 1 of 1 blocks of body c1: they may fall forever"));
  // Gravity along x: the cube beside is now above.
  EXPECT_THAT(report_of(cubes({"[0, 0, 0]"}, {"[3, 0, 0.5]"}) + "settle: {gravity: [-9.81, 0, 0]}\n").suspicious, IsEmpty());
  EXPECT_THAT(report_of(cubes({"[0, 0, 0]"}, {"[0, 0, 1.5]"}) + "settle: {gravity: [0, 0, 1]}\n").suspicious,
              ElementsAre(HasSubstr("nothing fixed lies below")));
}

TEST(Doctor, FindsBlocksThatTouchNothing) {
  EXPECT_THAT(report_of(cubes({}, {"[0, 0, 0]", "[0, 0, 1]", "[5, 0, 0]"}) + heat).suspicious,
              ElementsAre("1 of 1 blocks of body c2 touch nothing: no heat passes to or from them"));
  const std::string held =
      "heat: {initial: 300, until: 1, boundaries: [{body: c0, temperature: 400}, {body: c1, temperature: 300}]}\n";
  EXPECT_THAT(report_of(cubes({}, {"[0, 0, 0]", "[0, 0, 1.1]"}) + held + "contact: {conductance: 100}\n").suspicious,
              ElementsAre("no two blocks touch: no heat passes between any of them"));
  EXPECT_THAT(report_of(cubes({}, {"[0, 0, 0]", "[0, 0, 1.1]"}) + held).suspicious, IsEmpty()) << "two bodies, each for itself";
  EXPECT_THAT(report_of(cubes({}, {"[0, 0, 0]", "[0, 0, 1]"}) + held + "contact: {conductance: 100}\n").suspicious, IsEmpty());
}

TEST(Doctor, FindsAWindowThatReachesBeyondTheBlocks) {
  const auto with = [](const std::string& high) {
    return report_of(cubes({}, {"[0, 0, 0]"}) +
                     "heat:\n  initial: 300\n  until: 1\n  effective_conductivity: {low: [-0.5, -0.5, -0.5], high: " + high +
                     "}\noutput: {every: 1}\n")
        .suspicious;
  };
  EXPECT_THAT(with("[0.5, 0.5, 0.75]"),
              ElementsAre(HasSubstr("goes from -0.5 to 0.75 m along z, the blocks from -0.5 to 0.5")));
  EXPECT_THAT(with("[0.5, 0.5, 0.5]"), IsEmpty());
}

TEST(Doctor, FindsOutputsByTheMillion) {
  const std::string body = cubes({}, {"[0, 0, 0]"}) + "heat: {initial: 300, until: 1 h}\n";
  EXPECT_THAT(
      report_of(body + "output: {every: 1 ms}\n").suspicious,
      ElementsAre(HasSubstr("output.every of 0.001 s makes 3.6e+06 output times"), HasSubstr("frames will be written")));
  EXPECT_THAT(report_of(body + "output: {every: 10 ms, frames_every: 1 s}\n").suspicious, IsEmpty());
}

TEST(Doctor, FindsWhatIsNotUsed) {
  const std::string two =
      "materials: {a: {}, b: {}}\nbodies:\n  c: {box: {size: [1, 1, 1], centre: [0, 0, 0]}, material: a, mesh_size: "
      "1, fixed: true}\n  d: {box: {size: [1, 1, 1], centre: [3, 0, 0]}, material: a, mesh_size: 1}\n";
  EXPECT_THAT(report_of(two).suspicious,
              ElementsAre("no body is made of material b", "body d is free, but nothing moves without a settle section",
                          "the scene has neither a settle nor a heat section: nothing happens"));
}

TEST(Doctor, FindsTemperaturesThatLackTheirUnitInEveryForm) {
  const std::string scene = cubes({}, {"[0, 0, 0]"});
  const std::string end = "\noutput: {every: 1, probes: {p: {point: [0, 0, 0], exact: 20}}}\n";
  EXPECT_THAT(
      report_of(scene +
                "heat: {initial: {expression: 20 + 100*x}, until: 1, boundaries: [{body: c0, temperature: {table: [[0 s, "
                "400], [1 h, 30]]}}]}" +
                end)
          .suspicious,
      ElementsAre("heat.initial is 20 at the origin and time 0, which is in kelvin: give it `unit: degC` if that is meant",
                  "heat.boundaries[0].temperature.table[1][1] is 30, which is in kelvin: write 30 degC if that is meant",
                  "output.probes.p.exact is 20, which is in kelvin: write 20 degC if that is meant"));
  EXPECT_THAT(
      report_of(scene + "heat: {initial: {expression: 20 + 100*x, unit: degC}, until: 1}\noutput: {every: 1}\n").suspicious,
      IsEmpty());
  EXPECT_THAT(
      report_of(
          "materials: {a: {density: 1, conductivity: {table: [[20, 3.1], [100, 2.5]]}, specific_heat: 1}}\nbodies: {c: {box: "
          "{size: [1, 1, 1], centre: [0, 0, 0]}, material: a, mesh_size: 1}}\nheat: {initial: 300, until: 1}\n")
          .suspicious,
      ElementsAre("materials.a.conductivity.table[0][0] is 20, which is in kelvin: write 20 degC if that is meant"));
}

TEST(Doctor, FindsAnAngleThatLacksItsUnit) {
  const auto turned = [](const std::string& angle) {
    return cubes({}, {"[0, 0, 0], rotation: {axis: [0, 0, 1], angle: " + angle + "}"}) + heat;
  };
  EXPECT_THAT(report_of(turned("45")).suspicious,
              ElementsAre("bodies.c0.box.rotation.angle is 45, which is in radians: write 45 deg if that is meant"));
  EXPECT_THAT(report_of(turned("45 deg")).suspicious, IsEmpty());
  EXPECT_THAT(report_of(turned("1.5")).suspicious, IsEmpty());
}

TEST(Doctor, FindsTemperaturesThatLackTheirUnit) {
  const std::string scene = cubes({}, {"[0, 0, 0]"});
  EXPECT_THAT(
      report_of(scene + "heat: {initial: 25, until: 1, boundaries: [{body: c0, temperature: 100}]}\noutput: {every: 1}\n")
          .suspicious,
      ElementsAre("heat.initial is 25, which is in kelvin: write 25 degC if that is meant",
                  "heat.boundaries[0].temperature is 100, which is in kelvin: write 100 degC if that is meant"));
  EXPECT_THAT(report_of(scene + "heat: {initial: 77 K, until: 1}\noutput: {every: 1}\n").suspicious, IsEmpty());
}

}  // namespace

}  // namespace scree
