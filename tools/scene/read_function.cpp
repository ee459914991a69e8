// Quantities that depend on place, time or temperature, in the three forms a scene may give them.
#include "engine/base/curve.h"
#include "engine/base/function.h"
#include "tools/scene/sections.h"

namespace scree {

namespace {

// The unit a formula is in; SI without one.
std::optional<UnitConverter> read_unit(const Checked& value, Problems& problems) {
  const Checked* unit = value.find("unit");
  const auto converter = unit_converter(unit == nullptr ? "" : unit->text, value.key->quantity);
  if (const auto* problem = std::get_if<UnitProblem>(&converter)) {
    problems.push_back(unit->problem(unit->text, problem->reason, problem->suggestion));
    return std::nullopt;
  }
  return std::get<UnitConverter>(converter);
}

ValueRule rule_of(const Checked& value, const Checked& form) {
  ValueRule rule;
  rule.key = value.path;
  rule.where = form.where;
  rule.quantity = value.key->quantity;
  rule.range = value.key->range;
  return rule;
}

LinearTable inline_table(const Checked& table) {
  std::vector<double> places;
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < table.numbers.size(); i += 2) {
    places.push_back(table.numbers[i]);
    values.push_back(table.numbers[i + 1]);
  }
  return {std::move(places), std::move(values)};
}

Function table_of(const Checked& table, const ValueRule& rule, const Function& /*kind*/) {
  if (table.texts.empty()) return Function::from_table(std::filesystem::path(table.text), rule);
  return Function::from_table(inline_table(table), rule);
}

Curve table_of(const Checked& table, const ValueRule& rule, const Curve& /*kind*/) {
  if (table.texts.empty()) return Curve::from_table(std::filesystem::path(table.text), rule);
  return Curve::from_table(inline_table(table));
}

// A Function or a Curve.
template <class Kind>
Kind read_forms(const Checked& value, Problems& problems) {
  if (!value.is_map) return value.number();
  const Checked& expression = value.at("expression");
  const Checked& table = value.at("table");
  try {
    if (table.sound) return table_of(table, rule_of(value, table), Kind());
    const auto unit = expression.sound ? read_unit(value, problems) : std::nullopt;
    if (unit) return Kind::from_expression(expression.text, *unit, rule_of(value, expression));
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
  return {};
}

}  // namespace

Function read_function(const Checked& value, Problems& problems) {
  return read_forms<Function>(value, problems);
}

Curve read_curve(const Checked& value, Problems& problems) {
  return read_forms<Curve>(value, problems);
}

void check_lasts(const Function& function, const thermal::HeatOptions& options, Problems& problems) {
  try {
    function.check_time(0, options.time.steady ? 0 : options.time.until);
  } catch (const InputError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
}

}  // namespace scree
