// What a scene says of a material. A property the scene does not need may be left out.
#pragma once

#include <optional>
#include <string>

namespace scree {

struct Material {
  std::string name;
  std::optional<double> density;        // [kg/m3]
  std::optional<double> conductivity;   // [W/m/K]
  std::optional<double> specific_heat;  // [J/kg/K]
  double friction = 0.6;                // Coulomb coefficient between two bodies of this material [-]
  double restitution = 0.0;             // between two bodies of this material [-]
};

}  // namespace scree
