// What a scene says of a material. A property the scene does not need may be left out.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/base/curve.h"

namespace scree {

// Thermal conductivity: in a principal axis, the ratio of that axis times the value.
struct Conductivity {
  Conductivity(double constant) : value(constant) {}      // NOLINT(google-explicit-constructor): the same in all directions
  Conductivity(Curve curve) : value(std::move(curve)) {}  // NOLINT(google-explicit-constructor)

  Curve value;                                              // [W/m/K]
  Eigen::Vector3d ratio{1, 1, 1};                           // [-]; in 2-D the third is the mean of the others
  Eigen::Quaterniond axes{Eigen::Quaterniond::Identity()};  // principal axes in the body's frame; they turn with the block

  [[nodiscard]] bool varies() const { return !value.constant(); }  // with the temperature
  [[nodiscard]] bool isotropic() const { return ratio.maxCoeff() == ratio.minCoeff(); }
  [[nodiscard]] double mean(double temperature) const { return value(temperature) * ratio.mean(); }  // over the axes
};

struct Material {
  std::string name;
  std::optional<double> density;             // [kg/m3]
  std::optional<Conductivity> conductivity;  // [W/m/K]
  std::optional<Curve> specific_heat;        // [J/kg/K]
  double friction = 0.6;                     // Coulomb coefficient between two bodies of this material [-]
  double restitution = 0.0;                  // between two bodies of this material [-]
};

}  // namespace scree
