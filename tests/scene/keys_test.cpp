#include "tools/scene/keys.h"

#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "engine/base/key_reference.h"
#include "tests/scene/scene_text.h"

namespace scree {

namespace {

using Json = nlohmann::json;
using test::scene_of;
using test::values_of;
using test::whole_scene;

// For each key that holds a value: what makes it present, and an assignment that changes it.
struct Change {
  std::string key;
  std::vector<std::string> before;
  std::string after;
};

const std::string shape_of_block = "bodies.block.sphere=null";
const std::string box = "bodies.block.box={size: [1, 1, 1], centre: [0, 0, 0], rotation: {axis: [0, 0, 1], angle: 1}}";
const std::string cylinder =
    "bodies.block.cylinder={diameter: 1, height: 1, centre: [0, 0, 0], rotation: {axis: [0, 0, 1], angle: 1}}";
const std::string file =
    "bodies.block.mesh={file: " SCREE_SOURCE_DIR "/LICENSE, position: [0, 0, 0], rotation: {axis: [0, 0, 1], angle: 1}}";
const std::string lattice =
    "bodies.block.lattice={count: [1, 2, 3], spacing: [1, 1, 1], centre: [0, 0, 0], rotation: [1, 0, 0, 0]}";
const std::string random_copies = "bodies.block.random={count: 1, low: [0, 0, 0], high: [1, 1, 1]}";
const std::string at = "bodies.block.at=[{position: [0, 0, 0], rotation: [1, 0, 0, 0]}]";
const std::string no_centre = "bodies.block.sphere.centre=null";
const std::string turned = "{axis: [1, 0, 0], angle: 1}";

const std::string turned_axes =
    "materials.ore.conductivity={value: 2, ratio: [1, 2, 3], rotation: {axis: [1, 0, 0], angle: 1}}";
const std::string convection = "heat.boundaries[0]={body: plate, convection: {coefficient: 5, surroundings: 300}}";
const std::string radiation = "heat.boundaries[0]={body: plate, radiation: {emissivity: 0.5, surroundings: 300}}";

std::vector<Change> shape_changes() {
  const std::string b = "bodies.block.";
  const std::vector<std::string> with_box{shape_of_block, box}, with_cylinder{shape_of_block, cylinder},
      with_file{shape_of_block, file};
  return {{"bodies.*.box.size", with_box, b + "box.size=[1, 2, 1]"},
          {"bodies.*.box.centre", with_box, b + "box.centre=[1, 0, 0]"},
          {"bodies.*.box.rotation", with_box, b + "box.rotation=[0, 0, 0, 1]"},
          {"bodies.*.box.rotation.axis", with_box, b + "box.rotation.axis=[1, 0, 0]"},
          {"bodies.*.box.rotation.angle", with_box, b + "box.rotation.angle=2"},
          {"bodies.*.sphere.diameter", {}, b + "sphere.diameter=2"},
          {"bodies.*.sphere.centre", {}, b + "sphere.centre=[3, 0, 0]"},
          {"bodies.*.cylinder.diameter", with_cylinder, b + "cylinder.diameter=2"},
          {"bodies.*.cylinder.height", with_cylinder, b + "cylinder.height=2"},
          {"bodies.*.cylinder.centre", with_cylinder, b + "cylinder.centre=[0, 1, 0]"},
          {"bodies.*.cylinder.rotation", with_cylinder, b + "cylinder.rotation=[0, 0, 0, 1]"},
          {"bodies.*.cylinder.rotation.axis", with_cylinder, b + "cylinder.rotation.axis=[1, 0, 0]"},
          {"bodies.*.cylinder.rotation.angle", with_cylinder, b + "cylinder.rotation.angle=2"},
          {"bodies.*.mesh.file", with_file, b + "mesh.file=" SCREE_SOURCE_DIR "/CHANGELOG.md"},
          {"bodies.*.mesh.scale", with_file, b + "mesh.scale=1 mm"},
          {"bodies.*.mesh.position", with_file, b + "mesh.position=[1, 0, 0]"},
          {"bodies.*.mesh.rotation", with_file, b + "mesh.rotation=[0, 0, 0, 1]"},
          {"bodies.*.mesh.rotation.axis", with_file, b + "mesh.rotation.axis=[1, 0, 0]"},
          {"bodies.*.mesh.rotation.angle", with_file, b + "mesh.rotation.angle=2"}};
}

std::vector<Change> copy_changes() {
  const std::string b = "bodies.block.";
  const std::vector<std::string> on_lattice{no_centre, lattice}, at_random{no_centre, random_copies}, at_places{no_centre, at};
  const std::vector<std::string> turned_lattice{no_centre, lattice, b + "lattice.rotation=" + turned};
  const std::vector<std::string> turned_at{no_centre, at, b + "at[0].rotation=" + turned};
  return {{"bodies.*.lattice.count", on_lattice, b + "lattice.count=[1, 2, 4]"},
          {"bodies.*.lattice.spacing", on_lattice, b + "lattice.spacing=[1, 2, 1]"},
          {"bodies.*.lattice.centre", on_lattice, b + "lattice.centre=[1, 0, 0]"},
          {"bodies.*.lattice.rotation", on_lattice, b + "lattice.rotation=[0, 0, 0, 1]"},
          {"bodies.*.lattice.rotation.axis", turned_lattice, b + "lattice.rotation.axis=[0, 1, 0]"},
          {"bodies.*.lattice.rotation.angle", turned_lattice, b + "lattice.rotation.angle=2"},
          {"bodies.*.random.count", at_random, b + "random.count=2"},
          {"bodies.*.random.low", at_random, b + "random.low=[-1, 0, 0]"},
          {"bodies.*.random.high", at_random, b + "random.high=[1, 2, 1]"},
          {"bodies.*.random.seed", at_random, b + "random.seed=2"},
          {"bodies.*.random.rotate", at_random, b + "random.rotate=false"},
          {"bodies.*.at[].position", at_places, b + "at[0].position=[1, 0, 0]"},
          {"bodies.*.at[].rotation", at_places, b + "at[0].rotation=[0, 0, 0, 1]"},
          {"bodies.*.at[].rotation.axis", turned_at, b + "at[0].rotation.axis=[0, 1, 0]"},
          {"bodies.*.at[].rotation.angle", turned_at, b + "at[0].rotation.angle=2"}};
}

std::vector<Change> world_changes() {
  return {{"title", {}, "title=other"},
          {"dimension", {}, "dimension=2"},
          {"packing", {"settle=null"}, "packing=" SCREE_SOURCE_DIR "/LICENSE"},
          {"materials.*.density", {}, "materials.ore.density=1"},
          {"materials.*.conductivity", {}, "materials.ore.conductivity=1"},
          {"materials.*.conductivity.value", {"materials.ore.conductivity={value: 2}"}, "materials.ore.conductivity.value=1"},
          {"materials.*.conductivity.ratio",
           {"materials.ore.conductivity={value: 2}"},
           "materials.ore.conductivity.ratio=[1, 2, 3]"},
          {"materials.*.conductivity.rotation", {turned_axes}, "materials.ore.conductivity.rotation=[0, 0, 0, 1]"},
          {"materials.*.conductivity.rotation.axis", {turned_axes}, "materials.ore.conductivity.rotation.axis=[0, 1, 0]"},
          {"materials.*.conductivity.rotation.angle", {turned_axes}, "materials.ore.conductivity.rotation.angle=2"},
          {"materials.*.specific_heat", {}, "materials.ore.specific_heat=1"},
          {"materials.*.friction", {}, "materials.ore.friction=1"},
          {"materials.*.restitution", {}, "materials.ore.restitution=1"},
          {"bodies.*.material", {"heat=null", "output=null"}, "bodies.block.material=ice"},
          {"bodies.*.mesh_size", {}, "bodies.block.mesh_size=1"},
          {"bodies.*.elements", {}, "bodies.block.elements=hexahedron"},
          {"bodies.*.blocks", {}, "bodies.block.blocks=per_element"},
          {"bodies.*.fixed", {}, "bodies.block.fixed=true"},
          {"bodies.*.velocity", {}, "bodies.block.velocity=[1, 0, 0]"},
          {"settle.gravity", {}, "settle.gravity=[0, 0, -1]"},
          {"settle.limit", {}, "settle.limit=1"},
          {"settle.step", {}, "settle.step=1 ms"},
          {"settle.local_damping", {}, "settle.local_damping=0.5"},
          {"settle.viscous_damping", {}, "settle.viscous_damping=1"},
          {"settle.release_time", {}, "settle.release_time=1"},
          {"settle.rest_displacement", {}, "settle.rest_displacement=1"},
          {"settle.clearance", {}, "settle.clearance=1e-4"},
          {"settle.iterations", {}, "settle.iterations=1"},
          {"settle.rest_speed", {}, "settle.rest_speed=1"},
          {"settle.rest_unbalanced_force", {}, "settle.rest_unbalanced_force=1"},
          {"settle.rest_window", {}, "settle.rest_window=1"},
          {"settle.frame_interval", {}, "settle.frame_interval=1"},
          {"settle.seed", {}, "settle.seed=5"},
          {"settle.largest_overlap", {}, "settle.largest_overlap=0.1"},
          {"settle.accept_moving", {}, "settle.accept_moving=true"}};
}

std::vector<Change> contact_changes() {
  const std::vector<std::string> joint{"contact.joints=[{bodies: [plate, block], conductance: 5}]"};
  const std::vector<std::string> by_material{"contact.joints=[{materials: [ore, ore], perfect: true}]"};
  const std::vector<std::string> soft{"contact.joints=[{bodies: [plate, block], stiffness_factor: 5}]"};
  return {{"contact.model", {}, "contact.model=overlap"},
          {"contact.conductance", {"contact.stiffness_factor=null"}, "contact.conductance=7"},
          {"contact.perfect", {"contact.stiffness_factor=null"}, "contact.perfect=true"},
          {"contact.insulating", {"contact.stiffness_factor=null"}, "contact.insulating=true"},
          {"contact.joints[].bodies[]", joint, "contact.joints[0].bodies=[block, block]"},
          {"contact.joints[].materials[]", by_material, "contact.joints[0].materials=[ore, ice]"},
          {"contact.joints[].model", joint, "contact.joints[0].model=semi_spring"},
          {"contact.joints[].stiffness_factor", soft, "contact.joints[0].stiffness_factor=6"},
          {"contact.joints[].conductance", joint, "contact.joints[0].conductance=6"},
          {"contact.joints[].perfect", joint, "contact.joints=[{bodies: [plate, block], perfect: true}]"},
          {"contact.joints[].insulating", joint, "contact.joints=[{bodies: [plate, block], insulating: true}]"},
          {"contact.indentation", {}, "contact.indentation=0.01"},
          {"contact.tolerance", {}, "contact.tolerance=1"},
          {"contact.stiffness_factor", {}, "contact.stiffness_factor=1"},
          {"contact.form", {}, "contact.form=literal"}};
}

std::vector<Change> heat_changes() {
  return {{"heat.initial", {}, "heat.initial=1"},
          {"heat.initial.*", {"heat.initial={plate: 1, block: 2}"}, "heat.initial.plate=2"},
          {"heat.boundaries[].body", {}, "heat.boundaries[0].body=block"},
          {"heat.boundaries[].surface", {}, "heat.boundaries[0].surface=top"},
          {"heat.boundaries[].temperature", {}, "heat.boundaries[0].temperature=1"},
          {"heat.boundaries[].convection.coefficient", {convection}, "heat.boundaries[0].convection.coefficient=1"},
          {"heat.boundaries[].convection.surroundings", {convection}, "heat.boundaries[0].convection.surroundings=1"},
          {"heat.boundaries[].radiation.emissivity", {radiation}, "heat.boundaries[0].radiation.emissivity=1"},
          {"heat.boundaries[].radiation.surroundings", {radiation}, "heat.boundaries[0].radiation.surroundings=1"},
          {"heat.boundaries[].flux", {}, "heat.boundaries[1].flux=1"},
          {"heat.boundaries[].flow", {}, "heat.boundaries[2].flow=1"},
          {"heat.boundaries[].name", {}, "heat.boundaries[0].name=x"},
          {"heat.boundaries[].within.low", {}, "heat.boundaries[1].within.low=[-1, 0, 0]"},
          {"heat.boundaries[].within.high", {}, "heat.boundaries[1].within.high=[2, 1, 1]"},
          {"heat.sources[].body", {}, "heat.sources[0].body=plate"},
          {"heat.sources[].power", {}, "heat.sources[0].power=1"},
          {"heat.sources[].name", {}, "heat.sources[0].name=x"},
          {"heat.sources[].within.low",
           {"heat.sources[0].within={low: [0, 0, 0], high: [1, 1, 1]}"},
           "heat.sources[0].within.low=[-1, 0, 0]"},
          {"heat.sources[].within.high",
           {"heat.sources[0].within={low: [0, 0, 0], high: [1, 1, 1]}"},
           "heat.sources[0].within.high=[2, 1, 1]"},
          {"heat.blocks.model", {}, "heat.blocks.model=lumped"},
          {"heat.blocks.largest_biot", {"heat.blocks.model=auto"}, "heat.blocks.largest_biot=0.02"},
          {"heat.blocks.bodies.*", {"heat.blocks.model=auto"}, "heat.blocks.bodies.plate=meshed"},
          {"heat.effective_conductivity.low",
           {"heat.effective_conductivity={low: [0, 0, 0], high: [1, 1, 1]}"},
           "heat.effective_conductivity.low=[-1, 0, 0]"},
          {"heat.effective_conductivity.high",
           {"heat.effective_conductivity={low: [0, 0, 0], high: [1, 1, 1]}"},
           "heat.effective_conductivity.high=[2, 1, 1]"},
          {"heat.initial.from", {"heat.initial={from: a}"}, "heat.initial.from=b"},
          {"heat.initial.time", {"heat.initial={from: a}"}, "heat.initial.time=1 min"},
          {"heat.initial.reach", {"heat.initial={from: a}"}, "heat.initial.reach=1 mm"},
          {"heat.steady", {}, "heat.steady=true"},
          {"heat.until", {}, "heat.until=1"},
          {"heat.tolerance", {}, "heat.tolerance=1"},
          {"heat.integrator", {}, "heat.integrator=explicit_euler"},
          {"heat.space_order", {}, "heat.space_order=4"},
          {"heat.solver", {}, "heat.solver=multigrid"},
          {"heat.step", {"heat.integrator=explicit_euler"}, "heat.step=1"},
          {"output.every", {}, "output.every=1"},
          {"output.frames_every", {"output.every=1"}, "output.frames_every=3"},
          {"output.probes.*", {}, "output.probes.low=[1, 0, 0]"},
          {"output.probes.*.point", {}, "output.probes.high.point=[1, 0, 0]"},
          {"output.probes.*.reach", {}, "output.probes.high.reach=1"},
          {"output.probes.*.exact", {}, "output.probes.high.exact=40 degC"}};
}

std::map<std::string, Change> all_changes() {
  std::map<std::string, Change> changes;
  for (const auto& part : {world_changes(), shape_changes(), copy_changes(), contact_changes(), heat_changes()}) {
    for (const Change& change : part) changes[change.key] = change;
  }
  return changes;
}

// The other forms of a quantity, on the path that the change of the quantity itself names.
Change implied_change(const Key& key, const std::map<std::string, Change>& changes) {
  const auto dot = key.path.rfind('.');
  Change change = changes.at(key.path.substr(0, dot));
  const std::string form = key.path.substr(dot + 1);
  const std::string path = change.after.substr(0, change.after.find('='));
  const Key& quantity = *scene_keys().find(key.path.substr(0, dot));
  if (form == "table") {
    change.before.push_back(path + "={table: [[0, 1], [1e6, 1]]}");
    change.after = path + ".table=[[0, 0.5], [1e6, 0.5]]";
    if (path.starts_with("heat.initial")) {
      change.before.back() = path + "={table: " SCREE_SOURCE_DIR "/tests/scene/along_x.csv}";
      change.after = path + "={expression: 5}";
    }
  } else {
    change.before.push_back(path + "={expression: 0.7 + 0, unit: " +
                            (quantity.quantity.unit.empty() ? "m/m" : std::string(quantity.quantity.unit)) + "}");
    const std::string other =
        quantity.quantity.unit.empty() ? std::string("%") : std::string("k").append(quantity.quantity.unit);
    change.after = form == "expression" ? path + ".expression=0.5" : path + ".unit=\"" + other + "\"";
  }
  return change;
}

TEST(SceneKeys, EveryKeyOfTheTableIsRead) {
  const auto changes = all_changes();
  for (const Key& key : scene_keys().keys()) {
    if (key.type == KeyType::section || key.type == KeyType::names || key.type == KeyType::list) continue;
    const auto place = changes.find(key.path);
    ASSERT_TRUE(key.implied || place != changes.end()) << key.path << " has no change in this test";
    const Change change = key.implied ? implied_change(key, changes) : place->second;
    const std::string before = values_of(scene_of(whole_scene, change.before));
    std::vector<std::string> overrides = change.before;
    overrides.push_back(change.after);
    try {
      EXPECT_NE(values_of(scene_of(whole_scene, overrides)), before) << key.path;
    } catch (const InputError& error) {
      // A dimension that this scene cannot have, and keys that the steady state has no use for: read all the same.
      EXPECT_TRUE(key.path == "dimension" || key.path == "heat.steady") << key.path << ": " << error.what();
    }
  }
}

TEST(SceneKeys, EveryKeyHasAMeaning) {
  for (const Key& key : scene_keys().keys()) {
    EXPECT_TRUE(key.meaning.ends_with('.') || key.meaning.ends_with(']')) << key.path;
    EXPECT_LT(key.meaning.size(), 120u) << key.path;
  }
}

TEST(SceneKeys, TheReferenceIsGroupedAndFiltered) {
  const std::string all = key_reference(scene_keys());
  for (const char* section : {"\n\nmaterials ", "\n\nbodies ", "\n\nsettle ", "\n\ncontact ", "\n\nheat ", "\n\noutput "}) {
    EXPECT_THAT(all, testing::HasSubstr(section));
  }
  const std::string some = key_reference(scene_keys(), "contact.f");
  EXPECT_THAT(some, testing::HasSubstr("contact.form  one of consistent, literal  consistent  "));
  EXPECT_THAT(some, testing::Not(testing::HasSubstr("contact.model")));
}

// Every object of the schema: closed, and its required keys among its properties.
void check_objects(const Json& schema) {
  if (schema.is_object() && schema.value("type", Json()) == "object") {
    ASSERT_TRUE(schema.contains("additionalProperties"));
    for (const auto& name : schema.value("required", Json::array())) EXPECT_TRUE(schema["properties"].contains(name)) << name;
  }
  if (schema.is_structured()) {
    for (const auto& part : schema) check_objects(part);
  }
}

TEST(SceneKeys, TheSchemaSaysWhatTheTableSays) {
  const Json schema = Json::parse(key_schema(scene_keys(), "Scree scene"));
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  check_objects(schema);
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], Json::array({"materials", "bodies"}));
  const Json& material = schema["properties"]["materials"]["additionalProperties"]["properties"];
  EXPECT_EQ(material["density"]["anyOf"][0]["exclusiveMinimum"], 0);
  EXPECT_EQ(material["restitution"]["anyOf"][0]["maximum"], 1);
  const Json& body = schema["properties"]["bodies"]["additionalProperties"];
  EXPECT_EQ(body["properties"]["blocks"]["enum"], Json::array({"whole", "per_element"}));
  EXPECT_EQ(body["allOf"][0]["oneOf"].size(), 4u);
  EXPECT_EQ(schema["properties"]["dimension"]["enum"], Json::array({2, 3}));
  EXPECT_EQ(schema["properties"]["contact"]["properties"]["insulating"]["enum"], Json::array({true}))
      << "as an editor reads it";
  EXPECT_EQ(schema["properties"]["output"]["properties"]["probes"]["additionalProperties"]["anyOf"].size(), 2u);
  for (const auto& [name, section] : schema["properties"].items()) EXPECT_TRUE(section.contains("description")) << name;
}

}  // namespace

}  // namespace scree
