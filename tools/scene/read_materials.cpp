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
    result.push_back(Material{.name = entry.name,
                              .density = optional_number(entry.value.find("density")),
                              .conductivity = optional_number(entry.value.find("conductivity")),
                              .specific_heat = optional_number(entry.value.find("specific_heat")),
                              .friction = entry.value.at("friction").number(),
                              .restitution = entry.value.at("restitution").number()});
  }
  return result;
}

}  // namespace scree
