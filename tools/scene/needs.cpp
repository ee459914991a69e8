#include <algorithm>

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "tools/scene/heat_models.h"
#include "tools/scene/sections.h"

namespace scree {

namespace {

// One material property that a body cannot do without.
void need(const Checked& material, const std::string& property, const std::string& reason, Problems& problems) {
  if (material.find(property) != nullptr || !material.sound) return;
  for (const Problem& known : problems) {
    if (known.key == material.path + "." + property) return;  // another body needs it, too
  }
  problems.push_back({material.where, material.path + "." + property, "missing", reason, ""});
}

// A material that only a value from outside the file names is a name misspelt, which would change nothing, unless a body is
// made of it.
void check_new_materials(const Scene& scene, const Checked& materials, Problems& problems) {
  for (const MaterialId id : scene.materials.ids()) {
    const CheckedEntry& entry = materials.entries[id.index()];
    const bool used =
        std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const auto& body) { return body.material == id; });
    if (used || !entry.where.file.starts_with("--set materials." + entry.name)) continue;
    std::vector<std::string> others = names_of(materials);
    std::erase(others, entry.name);
    problems.push_back(
        {entry.where, "materials." + entry.name, "new", "must be a material of this scene", suggest(entry.name, others)});
  }
}

// Nothing: no property does.
const Material* varying_material(const Scene& scene) {
  for (const mesh::BodySpec& body : scene.bodies) {
    if (body.material.valid() && varies(scene.materials[body.material])) return &scene.materials[body.material];
  }
  return nullptr;
}

void check_effective_conductivity(const Scene& scene, const Checked& window, Problems& problems) {
  const Material* varying = varying_material(scene);
  if (varying == nullptr) return;
  problems.push_back(window.problem(window.text,
                                    "needs constant properties: those of " + varying->name + " depend on temperature",
                                    "Give the values at the temperature of interest"));
}

// What makes the equations of heat other than linear with constant coefficients; empty: nothing.
std::string changing_equations(const Scene& scene) {
  if (const Material* varying = varying_material(scene)) {
    return fmt::format("properties of {} depend on temperature", varying->name);
  }
  for (const thermal::Boundary& boundary : scene.heat->boundaries) {
    if (std::holds_alternative<thermal::Radiation>(boundary.condition))
      return fmt::format("{} is not linear in temperature", boundary.name);
    const auto* convection = std::get_if<thermal::Convection>(&boundary.condition);
    if (convection == nullptr || !convection->coefficient.varies_in_time()) continue;
    return fmt::format("the coefficient of {} changes in time", boundary.name);
  }
  return {};
}

bool varies_in_time(const thermal::FixedTemperature& held) {
  return held.temperature.varies_in_time();
}
bool varies_in_time(const thermal::HeatFlux& flux) {
  return flux.flux.varies_in_time();
}
bool varies_in_time(const thermal::HeatFlow& flow) {
  return flow.flow.varies_in_time();
}
bool varies_in_time(const thermal::Convection& convection) {
  return convection.coefficient.varies_in_time() || convection.surroundings.varies_in_time();
}
bool varies_in_time(const thermal::Radiation& radiation) {
  return radiation.emissivity.varies_in_time() || radiation.surroundings.varies_in_time();
}

// Which condition changes in time; empty: none.
std::string changing_condition(const thermal::HeatOptions& heat) {
  for (const thermal::Boundary& boundary : heat.boundaries) {
    const bool changes = std::visit([](const auto& condition) { return varies_in_time(condition); }, boundary.condition);
    if (changes) return fmt::format("{} changes in time", boundary.name);
  }
  for (const thermal::Source& source : heat.sources) {
    if (source.power.varies_in_time()) return fmt::format("{} changes in time", source.name);
  }
  return {};
}

// Euler's steps and those of fourth order in space are for linear equations, these for conditions that stay, too.
void check_integrator(const Scene& scene, const Checked& heat, Problems& problems) {
  using enum thermal::Integrator;
  const thermal::TimeOptions& time = scene.heat->time;
  const bool fourth = scene.heat->space_order == thermal::SpaceOrder::fourth;
  if (time.steady || (!fourth && time.integrator != explicit_euler)) return;
  std::string reason = changing_equations(scene);
  if (reason.empty() && fourth) reason = changing_condition(*scene.heat);
  if (reason.empty()) return;
  const Checked& asked = heat.at(fourth ? "space_order" : "integrator");
  problems.push_back(asked.problem(asked.text, "does only what does not change: " + reason,
                                   fourth ? "Set space_order: 2" : "Use the implicit integrator"));
}

}  // namespace

void check_needs(const Scene& scene, const Checked& checked, Problems& problems) {
  for (const mesh::BodySpec& body : scene.bodies) {
    if (!body.material.valid()) continue;
    const Checked& material = checked.at("materials").entries[body.material.index()].value;
    const bool falls = scene.settle.has_value() && !body.fixed;
    if (falls) need(material, "density", fmt::format("body {} is free to fall", body.name), problems);
    if (!scene.heat) continue;
    const std::string reason = fmt::format("heat is modelled in body {}", body.name);
    need(material, "conductivity", reason, problems);
    if (scene.heat->time.steady) continue;
    for (const char* property : {"density", "specific_heat"}) need(material, property, reason, problems);
  }
  check_new_materials(scene, checked.at("materials"), problems);
  if (!scene.heat) return;
  check_integrator(scene, checked.at("heat"), problems);
  if (scene.effective_window) check_effective_conductivity(scene, checked.at("heat").at("effective_conductivity"), problems);
}

}  // namespace scree
