#include "tools/scene/sections.h"

namespace scree {

namespace {

// The first principal axis has the value, the others a ratio of it. In 2-D the third, which nothing is conducted along, keeps
// the mean of the others.
void set_ratio(Conductivity& conductivity, Eigen::Vector3d ratio, int dimension) {
  if (dimension == 2) ratio.z() = 0.5 * (ratio.x() + ratio.y());
  conductivity.ratio = ratio;
}

// A number, one for each axis, or a map with a form of the value and the principal axes.
Conductivity read_conductivity(const Checked& value, int dimension, Problems& problems) {
  if (!value.is_map) {
    Conductivity conductivity = value.number();
    if (value.numbers.size() > 1 && value.sound) set_ratio(conductivity, value.vector() / value.number(), dimension);
    return conductivity;
  }
  const Checked* number = value.find("value");
  Conductivity conductivity = number != nullptr ? Curve(number->number()) : read_curve(value, problems);
  if (const Checked* ratio = value.find("ratio")) {
    if (ratio->sound) set_ratio(conductivity, ratio->vector(), dimension);
  }
  conductivity.axes = read_rotation(value.find("rotation"), dimension, problems);
  return conductivity;
}

}  // namespace

Table<MaterialId, Material> read_materials(const Checked& materials, int dimension, Problems& problems) {
  Table<MaterialId, Material> result;
  for (const CheckedEntry& entry : materials.entries) {
    Material material;
    material.name = entry.name;
    if (const Checked* density = entry.value.find("density")) material.density = density->number();
    if (const Checked* k = entry.value.find("conductivity")) material.conductivity = read_conductivity(*k, dimension, problems);
    if (const Checked* heat = entry.value.find("specific_heat")) material.specific_heat = read_curve(*heat, problems);
    material.friction = entry.value.at("friction").number();
    material.restitution = entry.value.at("restitution").number();
    result.push_back(std::move(material));
  }
  return result;
}

}  // namespace scree
