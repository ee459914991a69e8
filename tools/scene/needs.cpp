#include <fmt/format.h>

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

}  // namespace

void check_needs(const Scene& scene, const Checked& checked, Problems& problems) {
  for (const mesh::BodySpec& body : scene.bodies) {
    if (!body.material.valid()) continue;
    const Checked& material = checked.at("materials").entries[body.material.index()].value;
    const bool falls = scene.settle.has_value() && !body.fixed;
    if (falls) need(material, "density", fmt::format("body {} is free to fall", body.name), problems);
    if (!scene.heat) continue;
    const std::string reason = fmt::format("heat is modelled in body {}", body.name);
    for (const char* property : {"density", "conductivity", "specific_heat"}) need(material, property, reason, problems);
  }
}

}  // namespace scree
