#include "tools/scene/sections.h"

namespace scree {

namespace {

std::optional<double> optional_number(const Checked* value) {
  return value == nullptr ? std::nullopt : std::optional(value->number());
}

}  // namespace

Table<MaterialId, Material> read_materials(const Checked& materials) {
  Table<MaterialId, Material> result;
  for (const CheckedEntry& entry : materials.entries) {
    Material material;
    material.name = entry.name;
    material.density = optional_number(entry.value.find("density"));
    if (const Checked* conductivity = entry.value.find("conductivity")) material.conductivity = conductivity->number();
    if (const Checked* heat = entry.value.find("specific_heat")) material.specific_heat = heat->number();
    material.friction = entry.value.at("friction").number();
    material.restitution = entry.value.at("restitution").number();
    result.push_back(std::move(material));
  }
  return result;
}

}  // namespace scree
