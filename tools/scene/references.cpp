// What several sections share: names of bodies and materials, rotations, boxes of space.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "tools/scene/sections.h"

namespace scree {

std::vector<std::string> names_of(const Checked& map) {
  std::vector<std::string> names;
  for (const CheckedEntry& entry : map.entries) names.push_back(entry.name);
  return names;
}

template <class IdType>
IdType resolve(const Checked& reference, const std::vector<std::string>& names, const std::string& what, Problems& problems) {
  if (!reference.sound) return {};
  const auto place = std::find(names.begin(), names.end(), reference.text);
  if (place != names.end()) return IdType{static_cast<std::size_t>(place - names.begin())};
  problems.push_back(
      reference.problem(reference.text, fmt::format("must be a {} of this scene", what), suggest(reference.text, names)));
  return {};
}
template BodyId resolve(const Checked&, const std::vector<std::string>&, const std::string&, Problems&);
template MaterialId resolve(const Checked&, const std::vector<std::string>&, const std::string&, Problems&);

Eigen::Quaterniond read_rotation(const Checked* rotation, int dimension, Problems& problems) {
  Eigen::Quaterniond result = Eigen::Quaterniond::Identity();
  if (rotation == nullptr || !rotation->sound) return result;
  if (rotation->is_map) {
    const Checked& axis = rotation->at("axis");
    if (dimension == 3 && !axis.sound) return result;
    const Eigen::Vector3d direction = dimension == 2 ? Eigen::Vector3d::UnitZ() : axis.vector();
    if (direction.isZero(0)) {
      problems.push_back(axis.problem("zero", "must have a direction"));
      return result;
    }
    return Eigen::Quaterniond(Eigen::AngleAxisd(rotation->at("angle").number(), direction.stableNormalized()));
  }
  const std::vector<double>& q = rotation->numbers;
  result = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  // As many digits as a user types; anything further away is no rotation.
  constexpr double slack = 1e-3;
  if (std::abs(result.norm() - 1) > slack) {
    problems.push_back(rotation->problem("no rotation", "a quaternion [w, x, y, z] must have length 1"));
    return Eigen::Quaterniond::Identity();
  }
  if (dimension == 2 && (q[1] != 0 || q[2] != 0)) {
    problems.push_back(rotation->problem("out of the plane", "in 2-D, x and y of the quaternion must be 0"));
  }
  return result.normalized();
}

void check_corners(const Checked& region, Flat flat, int dimension, Problems& problems) {
  const Checked& low = region.at("low");
  const Checked& high = region.at("high");
  if (!low.sound || !high.sound) return;
  for (int i = 0; i < dimension; ++i) {
    const bool equal = low.vector()[i] == high.vector()[i];
    if (low.vector()[i] < high.vector()[i] || (equal && flat == Flat::allowed)) continue;
    const char axis = "xyz"[i];
    const auto at = static_cast<std::size_t>(i);
    problems.push_back(
        high.problem(fmt::format("{} in {}", high.texts[at], axis),
                     fmt::format("must be {} low, which is {}", flat == Flat::allowed ? "at least" : "above", low.texts[at]),
                     equal ? "" : "Swap low and high"));
    return;
  }
}

}  // namespace scree
