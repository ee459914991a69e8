// Quantities with units, as a user writes them: `12 h`, `3.1 W/(m K)`, `100 degC`, `5 %`. UDUNITS-2 knows the units.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace scree {

// What a number measures. A bare number is in `unit`.
struct Quantity {
  enum class Kind {
    scale,                   // converts by a factor
    temperature,             // 100 degC is 373.15 K
    temperature_difference,  // 0.1 degC is 0.1 K
  };
  std::string_view name;  // in messages, such as "length"
  std::string_view unit;  // SI; empty for a plain number
  Kind kind = Kind::scale;
};

namespace quantity {
inline constexpr Quantity number{"plain number", ""};
inline constexpr Quantity angle{"angle", "rad"};
inline constexpr Quantity length{"length", "m"};
inline constexpr Quantity time{"time", "s"};
inline constexpr Quantity rate{"rate", "s-1"};
inline constexpr Quantity speed{"speed", "m/s"};
inline constexpr Quantity acceleration{"acceleration", "m/s2"};
inline constexpr Quantity density{"density", "kg/m3"};
inline constexpr Quantity conductivity{"conductivity", "W/m/K"};
inline constexpr Quantity specific_heat{"specific heat", "J/kg/K"};
inline constexpr Quantity heat_flux{"heat flux", "W/m2"};
inline constexpr Quantity heat_flow{"heat flow", "W"};
inline constexpr Quantity heat_transfer{"heat transfer coefficient", "W/m2/K"};
inline constexpr Quantity power_density{"power per volume", "W/m3"};
inline constexpr Quantity temperature{"temperature", "K", Quantity::Kind::temperature};
inline constexpr Quantity temperature_difference{"temperature difference", "K", Quantity::Kind::temperature_difference};
}  // namespace quantity

// Why a text is no value of the wanted quantity.
struct UnitProblem {
  std::string reason;      // such as "h is no unit of length"
  std::string suggestion;  // such as "Did you mean 12 m?"; may be empty
};

// The value of `text` in SI. Finite.
std::variant<double, UnitProblem> parse_quantity(std::string_view text, const Quantity& quantity);

// From a unit to SI.
class UnitConverter {
 public:
  explicit UnitConverter(std::shared_ptr<const void> converter) : converter_(std::move(converter)) {}

  double operator()(double value) const;

 private:
  std::shared_ptr<const void> converter_;  // a cv_converter of UDUNITS-2, which does not change once it is made
};

// From the unit `spelling` of the quantity; a number of an empty one is in SI already.
std::variant<UnitConverter, UnitProblem> unit_converter(std::string_view spelling, const Quantity& quantity);

}  // namespace scree
