// Formulas for tests, in SI.
#pragma once

#include "engine/base/curve.h"
#include "engine/base/function.h"

namespace scree::thermal::test {

inline Function formula(const std::string& text) {
  return Function::from_expression(text, std::get<UnitConverter>(unit_converter("", quantity::number)), {});
}

inline Curve curve(const std::string& text) {
  return Curve::from_expression(text, std::get<UnitConverter>(unit_converter("", quantity::number)), {});
}

}  // namespace scree::thermal::test
