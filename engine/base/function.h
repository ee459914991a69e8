// A value that depends on place and time: a number, a formula or a table.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "engine/base/linear_table.h"
#include "engine/base/units.h"
#include "engine/base/value_rule.h"

namespace scree {

// Copies share what they were made from.
class Function {
 public:
  Function() = default;                         // 0
  Function(double value) : constant_(value) {}  // NOLINT(google-explicit-constructor): a number is a function, too

  // In x, y, z [m] and t [s]; its value is in `unit`. Throws InputError if it is no formula.
  static Function from_expression(const std::string& text, const UnitConverter& unit, const ValueRule& rule);

  // Over time, x, y or z, as the head of the file's first column says. Throws InputError.
  static Function from_table(const std::filesystem::path& file, const ValueRule& rule);

  // Over time [s], with values that are sound already.
  static Function from_table(LinearTable table, const ValueRule& rule);

  // Throws InputError that names place and time where the value breaks the rule or the table ends.
  double operator()(const Eigen::Vector3d& place, double time) const;

  [[nodiscard]] bool varies_in_time() const;
  [[nodiscard]] bool varies_in_place() const;
  [[nodiscard]] std::optional<double> constant() const;

  // Whether its value may jump, in place or in time: a table's does not.
  [[nodiscard]] bool may_jump() const;

  // How often a table over time may bend between two times; 0 for what does not change in time. Of a formula nothing: only its
  // values tell.
  [[nodiscard]] std::optional<std::size_t> bends_between(double begin, double end) const;

  // Throws InputError for a table over time that does not reach from `begin` to `end`.
  void check_time(double begin, double end) const;

  struct Form;  // anything but a number

 private:
  double constant_ = 0;
  std::shared_ptr<const Form> form_;
};

}  // namespace scree
