// What the values of a function or a curve have to be, and where they are written, for messages.
#pragma once

#include <cmath>
#include <string>

#include "engine/base/check.h"
#include "engine/base/range.h"
#include "engine/base/units.h"

namespace scree {

struct ValueRule {
  std::string key;  // such as heat.boundaries[0].temperature
  SourceLocation where = {};
  Quantity quantity = quantity::number;
  Range range = {};

  [[nodiscard]] bool holds(double value) const { return std::isfinite(value) && range.holds(value); }
  // "positive, W/m/K"
  [[nodiscard]] std::string words() const;
  [[nodiscard]] Problem problem(std::string value, std::string rule, std::string suggestion = "") const;
};

}  // namespace scree
