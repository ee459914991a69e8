// Quantities that depend on place, time or temperature, from a scene.
#include <fstream>

#include <gmock/gmock.h>

#include "tests/scene/scene_text.h"
#include "tests/temp_folder.h"
#include "tools/scene/doctor.h"

namespace scree {

namespace {

using test::scene_of;
using test::values_of;
using test::whole_scene;
using test::wrong_with;
using testing::HasSubstr;

const Eigen::Vector3d here(1, 2, 3);

TEST(SceneFunctions, BoundariesSourcesAndStartTakeFormulas) {
  const Scene scene = scene_of(
      whole_scene, {"heat.initial={plate: {expression: 20 + x, unit: degC}, block: 300}",
                    "heat.boundaries[0].temperature={expression: 300 + t/10}",
                    "heat.boundaries[1].flux={expression: x*y*z, unit: kW/m2}", "heat.sources[0].power={expression: exp(-t)}"});
  EXPECT_NEAR(scene.heat->initial_temperature[BodyId{0}](here, 0), 294.15, 1e-9);
  EXPECT_EQ(scene.heat->initial_temperature[BodyId{1}].constant(), 300);
  EXPECT_NEAR(std::get<thermal::FixedTemperature>(scene.heat->boundaries[0].condition).temperature(here, 50), 305, 1e-9);
  EXPECT_NEAR(std::get<thermal::HeatFlux>(scene.heat->boundaries[1].condition).flux(here, 0), 6000, 1e-9);
  EXPECT_NEAR(scene.heat->sources[0].power(here, 1), std::exp(-1), 1e-12);
}

TEST(SceneFunctions, ConvectionAndRadiationHaveTwoQuantitiesEach) {
  const Scene scene = scene_of(
      whole_scene, {"heat.boundaries[0]={body: plate, convection: {coefficient: 5, surroundings: 20 degC}}",
                    "heat.boundaries[1]={body: block, radiation: {emissivity: 90 %, surroundings: {expression: 280 + t}}}"});
  const auto& convection = std::get<thermal::Convection>(scene.heat->boundaries[0].condition);
  EXPECT_EQ(convection.coefficient.constant(), 5);
  EXPECT_EQ(convection.surroundings.constant(), 293.15);
  const auto& radiation = std::get<thermal::Radiation>(scene.heat->boundaries[1].condition);
  EXPECT_EQ(radiation.emissivity.constant(), 0.9);
  EXPECT_EQ(radiation.surroundings(here, 10), 290);
  EXPECT_EQ(scene.heat->boundaries[0].name, "convection of plate");
}

TEST(SceneFunctions, ConductivityTakesNumbersAxesAndCurves) {
  const auto conductivity = [](const std::string& yaml) {
    return *scene_of(whole_scene, {"materials.ore.conductivity=" + yaml}).materials[MaterialId{0}].conductivity;
  };
  const Conductivity axes = conductivity("[4, 2, 1]");
  EXPECT_EQ(axes.value.constant(), 4);
  EXPECT_EQ(axes.ratio, Eigen::Vector3d(1, 0.5, 0.25));
  const Conductivity curve = conductivity("{expression: 1000/T, unit: mW/m/K, ratio: [1, 2, 3], rotation: [0, 0, 0, 1]}");
  EXPECT_NEAR(curve.value(500), 0.002, 1e-15);
  EXPECT_EQ(curve.ratio, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(curve.axes.z(), 1);
  EXPECT_NEAR(conductivity("{table: [[0 degC, 2], [100 degC, 3]]}").value(323.15), 2.5, 1e-12);
}

TEST(SceneFunctions, MistakesAreNamedWithTheirPlace) {
  EXPECT_THAT(wrong_with(whole_scene, {"heat.boundaries[0].temperature={expression: 300 + w}"}),
              HasSubstr("heat.boundaries[0].temperature is 300 + w (must be a formula in x, y, z and t; w at its character 7"));
  EXPECT_THAT(wrong_with(whole_scene, {"heat.boundaries[0].temperature={expression: 3*t, unit: m}"}),
              HasSubstr("heat.boundaries[0].temperature.unit is m (m is no unit of temperature). Write it in K or another unit "
                        "of temperature"));
  EXPECT_THAT(wrong_with(whole_scene, {"heat.boundaries[0].temperature={table: [[0, 300], [60, 310]]}"}),
              HasSubstr("too short for a run from 0 to 43200 s"));
  EXPECT_THAT(wrong_with(whole_scene, {"heat.boundaries[0].temperature={table: nowhere.csv}"}),
              HasSubstr("the table cannot be read: No such file"));
  EXPECT_THAT(wrong_with(whole_scene, {"heat.boundaries[2].flow={expression: 3*x}"}), HasSubstr("must depend on time only"));
  EXPECT_THAT(wrong_with(whole_scene, {"heat.initial={expression: 300 + t}"}), HasSubstr("must depend on place only"));
  EXPECT_THAT(wrong_with(whole_scene, {"heat.steady=true"}),
              HasSubstr("heat.until is without use (of use only without heat.steady"));
  EXPECT_THAT(wrong_with(whole_scene, {"materials.ore.conductivity={expression: 2*x}"}),
              HasSubstr("must be a formula in T; x at its character 3 is no known name"));
}

TEST(SceneFunctions, TheEffectiveSceneHasEveryForm) {
  const auto file = test::temp_folder() / "table.csv";
  std::ofstream(file) << "time [h],temperature [degC]\n0,20\n12,80\n";
  const Scene scene = scene_of(
      whole_scene,
      {"heat.initial={expression: 20 + x, unit: degC}", "heat.boundaries[0].temperature={table: " + file.string() + "}",
       "heat.boundaries[1]={body: block, radiation: {emissivity: 0.5, surroundings: {expression: 280 + t}}}",
       "materials.ore.conductivity={table: [[0 degC, 2], [100 degC, 3]], ratio: [1, 2, 3]}"});
  EXPECT_EQ(values_of(scene_of(scene.effective)), values_of(scene));
  EXPECT_EQ(scene.tables, std::vector<std::filesystem::path>{file});
  const Scene start = scene_of(whole_scene, {"heat.initial={from: somewhere, time: 1 h, reach: 1 mm}"});
  EXPECT_EQ(values_of(scene_of(start.effective)), values_of(start));
  EXPECT_EQ(start.initial_field->time, 3600);
}

TEST(SceneFunctions, TheReportNamesWhatTheyAskFor) {
  const Scene scene = scene_of(
      whole_scene, {"heat.boundaries[0]={body: plate, name: wind, convection: {coefficient: 5, surroundings: 20 degC}}",
                    "materials.ore.conductivity={expression: 1000/T, ratio: [1, 2, 3]}"});
  std::string text;
  for (const Model& model : models_of(scene)) {
    text += model.name + (model.modelled ? ": yes, " : ": no, ") + model.reason + "\n";
  }
  EXPECT_THAT(text, HasSubstr("convection: yes, at wind\n"));
  EXPECT_THAT(text, HasSubstr("radiation: no, no boundary has it\n"));
  EXPECT_THAT(text, HasSubstr("properties over T: yes, they vary with temperature in ore\n"));
  EXPECT_THAT(text, HasSubstr("principal axes: yes, conductivity differs along the axes of ore\n"));
}

}  // namespace

}  // namespace scree
