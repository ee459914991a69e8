// A property that depends on temperature: a number, a table or a formula.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/linear_table.h"
#include "engine/base/units.h"
#include "engine/base/value_rule.h"

namespace scree {

// Copies share what they were made from.
class Curve {
 public:
  Curve() = default;                         // 0
  Curve(double value) : constant_(value) {}  // NOLINT(google-explicit-constructor): a number is a curve, too

  // In T [K]; its value is in `unit`. Throws InputError if it is no formula.
  static Curve from_expression(const std::string& text, const UnitConverter& unit, const ValueRule& rule);

  // Over temperature [K], constant beyond the ends. The values are sound already.
  static Curve from_table(LinearTable table);

  // From a file whose first column is `temperature`. Throws InputError.
  static Curve from_table(const std::filesystem::path& file, const ValueRule& rule);

  // At a temperature [K]; of a formula to 1e-11 of its value, but for a peak narrower than 0.02 K. From any thread. Throws
  // InputError that names the temperature at which a formula breaks the rule.
  double operator()(double temperature) const;

  // Of its value over temperature [per K], from any thread. Where a formula bends or jumps, and below 0 K, it is not known and
  // taken for 0.
  [[nodiscard]] double slope(double temperature) const;

  // From a temperature that is the curve's own, so that differences are what it is for: 0 K of a number, a table and a formula
  // that vanishes there, 300 K of others, or the nearest at which they have a value. Exact for a number and a table; of a
  // formula by Gauss's rule of five points in each kelvin, which is halved where the formula bends or jumps: exact to rounding
  // for polynomials to the ninth degree, rising wherever the formula is positive. Throws InputError where a formula without a
  // value lies in between. All of a formula is known below 50,000 K, and refused from there on.
  [[nodiscard]] double integral(double temperature) const;

  [[nodiscard]] std::optional<double> constant() const;

  struct Form;  // anything but a number

 private:
  double constant_ = 0;
  std::shared_ptr<const Form> form_;
};

}  // namespace scree
