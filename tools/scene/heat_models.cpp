#include "tools/scene/heat_models.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scree {

namespace {

using thermal::HeatOptions;

// A model that is there because of something with these names.
Model because_of(const std::string& name, const std::string& what, const std::vector<std::string>& names,
                 const std::string& otherwise) {
  if (names.empty()) return {name, false, otherwise};
  return {name, true, fmt::format("{} {}", what, fmt::join(names, ", "))};
}

// The law of the joints, and how many pairs have another.
std::string words_of(const thermal::JointOptions& joint) {
  std::string text = "joints are " + thermal::name_of(joint.law);
  if (const auto* beta = std::get_if<thermal::StiffnessFactor>(&joint.law)) {
    text = fmt::format("joints of stiffness factor {:g}", beta->factor);
  } else if (const auto* h = std::get_if<thermal::JointConductance>(&joint.law)) {
    text = fmt::format("joints of {:g} W/m2/K", h->conductance);
  }
  return joint.rules.empty() ? text : text + fmt::format(", and contact.joints has {}", joint.rules.size());
}

std::string words_of(thermal::Integrator integrator) {
  using enum thermal::Integrator;
  switch (integrator) {
    case automatic:
      return "steps that are chosen by their cost";
    case implicit:
      return "implicit steps";
    case stabilised_explicit:
      return "stabilised explicit steps";
    case explicit_euler:
      break;
  }
  return "explicit steps";
}

Model conduction(const HeatOptions& heat) {
  if (heat.time.steady) return {"conduction in blocks", true, "the scene has a heat section: the steady state, without time"};
  return {"conduction in blocks", true,
          fmt::format("the scene has a heat section: {:g} s in {}", heat.time.until, words_of(heat.time.integrator))};
}

Model fourth_order(const HeatOptions& heat) {
  const bool fourth = heat.space_order == thermal::SpaceOrder::fourth;
  return {"fourth order in space", fourth,
          fourth ? "heat.space_order is 4: neighbours share capacity, probes are read from cubic polynomials"
                 : "heat.space_order is 2"};
}

// Names of the boundaries with a condition.
template <class Condition>
std::vector<std::string> boundaries_with(const HeatOptions& heat) {
  std::vector<std::string> names;
  for (const thermal::Boundary& boundary : heat.boundaries) {
    if (std::holds_alternative<Condition>(boundary.condition)) names.push_back(boundary.name);
  }
  return names;
}

// Names of the materials that bodies are made of and that have a property.
template <class Has>
std::vector<std::string> materials_with(const Scene& scene, const Has& has) {
  std::vector<std::string> names;
  for (const MaterialId id : scene.materials.ids()) {
    const auto made_of = [&](const mesh::BodySpec& body) { return body.material == id; };
    const bool used = std::any_of(scene.bodies.begin(), scene.bodies.end(), made_of);
    if (used && has(scene.materials[id])) names.push_back(scene.materials[id].name);
  }
  return names;
}

bool has_axes(const Material& material) {
  return material.conductivity && !material.conductivity->isotropic();
}

Model lumped(const Scene& scene) {
  const thermal::BlockOptions& blocks = scene.heat->blocks;
  const std::string name = "lumped blocks";
  if (blocks.all_meshed()) return {name, false, "heat.blocks lumps none: every node has a temperature"};
  std::vector<std::string> lumped, chosen;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const thermal::BlockModel model = blocks.of(BodyId{i});
    if (model == thermal::BlockModel::lumped) lumped.push_back(scene.bodies[i].name);
    if (model == thermal::BlockModel::automatic) chosen.push_back(scene.bodies[i].name);
  }
  std::vector<std::string> parts;
  if (!lumped.empty()) parts.push_back(fmt::format("every block of {}", fmt::join(lumped, ", ")));
  if (!chosen.empty()) {
    parts.push_back(fmt::format("those of {} with a Biot number below {:g}", fmt::join(chosen, ", "), blocks.largest_biot));
  }
  return {name, true, fmt::format("heat.blocks gives one temperature to {}", fmt::join(parts, ", and to "))};
}

Model start(const Scene& scene) {
  if (!scene.initial_field) return {"earlier run", false, "heat.initial names temperatures, no earlier run"};
  return {"earlier run", true, fmt::format("heat.initial takes the temperatures of {}", scene.initial_field->from.string())};
}

}  // namespace

bool varies(const Material& material) {
  const bool conductivity = material.conductivity && material.conductivity->varies();
  return conductivity || (material.specific_heat && !material.specific_heat->constant());
}

std::vector<Model> heat_models(const Scene& scene) {
  const std::string absent = "the scene has no heat section";
  if (!scene.heat) return {{"conduction in blocks", false, absent}, {"heat through contacts", false, absent}};
  const HeatOptions& heat = *scene.heat;
  const std::size_t boundaries = heat.boundaries.size();
  const std::size_t sources = heat.sources.size();
  std::vector<Model> models{
      conduction(heat),
      fourth_order(heat),
      {"heat through contacts", true, fmt::format("heat passes between blocks that touch: {}", words_of(heat.joint))},
      {"boundaries", boundaries > 0,
       boundaries > 0 ? fmt::format("heat.boundaries has {}", boundaries) : "all surfaces are insulated"},
      because_of("convection", "at", boundaries_with<thermal::Convection>(heat), "no boundary has it"),
      because_of("radiation", "at", boundaries_with<thermal::Radiation>(heat), "no boundary has it"),
      {"sources", sources > 0, sources > 0 ? fmt::format("heat.sources has {}", sources) : "heat.sources is empty"},
      because_of("properties over T", "they vary with temperature in", materials_with(scene, varies),
                 "every conductivity and heat capacity is a number"),
      because_of("principal axes", "conductivity differs along the axes of", materials_with(scene, has_axes),
                 "every conductivity is the same in all directions"),
      lumped(scene),
      start(scene)};
  if (scene.effective_window) {
    models.push_back(
        {"effective conductivity", true, "the scene has heat.effective_conductivity: steady states of its box of space"});
  }
  return models;
}

}  // namespace scree
