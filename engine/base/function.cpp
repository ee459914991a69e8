#include "engine/base/function.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "engine/base/expression.h"
#include "engine/base/table_file.h"

namespace scree {

struct Function::Form {
  explicit Form(ValueRule value_rule) : rule(std::move(value_rule)) {}
  virtual ~Form() = default;
  Form(const Form&) = delete;
  Form& operator=(const Form&) = delete;

  [[nodiscard]] virtual double value(const Eigen::Vector3d& place, double time) const = 0;
  [[nodiscard]] virtual bool varies(char argument) const = 0;  // x, y, z or t
  [[nodiscard]] virtual bool may_jump() const { return false; }
  virtual void check_time(double begin, double end) const = 0;
  [[nodiscard]] virtual std::optional<std::size_t> bends_between(double begin, double end) const = 0;

  ValueRule rule;
};

namespace {

std::string at(const Eigen::Vector3d& place, double time) {
  return fmt::format("at x = {:g} m, y = {:g} m, z = {:g} m and t = {:g} s", place.x(), place.y(), place.z(), time);
}

class Formula : public Function::Form {
 public:
  Formula(const std::string& text, UnitConverter unit, ValueRule value_rule)
      : Form(std::move(value_rule)), expression_(text, {"x", "y", "z", "t"}), unit_(std::move(unit)), text_(text) {}

  [[nodiscard]] double value(const Eigen::Vector3d& place, double time) const override {
    const double result = unit_(expression_(std::array{place.x(), place.y(), place.z(), time}));
    if (!rule.holds(result)) {
      throw InputError(rule.problem(
          fmt::format("{:g}{}{} {}", result, rule.quantity.unit.empty() ? "" : " ", rule.quantity.unit, at(place, time)),
          "must be " + rule.words(), fmt::format("The formula is {}", text_)));
    }
    return result;
  }
  [[nodiscard]] bool varies(char argument) const override { return expression_.uses(std::string(1, argument)); }
  [[nodiscard]] bool may_jump() const override { return expression_.may_jump(); }
  void check_time(double /*begin*/, double /*end*/) const override {}
  [[nodiscard]] std::optional<std::size_t> bends_between(double /*begin*/, double /*end*/) const override {
    return varies('t') ? std::nullopt : std::optional<std::size_t>(0);
  }

 private:
  Expression expression_;
  UnitConverter unit_;
  std::string text_;
};

class Tabulated : public Function::Form {
 public:
  Tabulated(ReadTable table, std::string file, ValueRule value_rule)
      : Form(std::move(value_rule)), table_(std::move(table.values)), file_(std::move(file)) {
    argument_ = table.argument == "time" ? 't' : table.argument.front();
  }

  [[nodiscard]] double value(const Eigen::Vector3d& place, double time) const override {
    const double argument = argument_ == 't' ? time : place[argument_ - 'x'];
    if (!covers(argument)) refuse(fmt::format("without a value {}", at(place, time)));
    return table_(argument);
  }
  [[nodiscard]] bool varies(char argument) const override { return argument == argument_; }
  [[nodiscard]] std::optional<std::size_t> bends_between(double begin, double end) const override {
    return argument_ == 't' ? table_.places_between(begin, end) : 0;
  }
  void check_time(double begin, double end) const override {
    if (argument_ != 't' || (covers(begin) && covers(end))) return;
    refuse(fmt::format("too short for a run from {:g} to {:g} s", begin, end));
  }

 private:
  // Rounding at the ends of the table is no reason to refuse.
  [[nodiscard]] bool covers(double argument) const {
    const double slack = 1e-9 * std::max({std::abs(table_.first()), std::abs(table_.last()), table_.last() - table_.first()});
    return argument >= table_.first() - slack && argument <= table_.last() + slack;
  }
  [[noreturn]] void refuse(const std::string& value) const {
    const char* unit = argument_ == 't' ? "s" : "m";
    throw InputError(rule.problem(value,
                                  fmt::format("the table{}{} reaches from {:g} to {:g} {}", file_.empty() ? "" : " ", file_,
                                              table_.first(), table_.last(), unit),
                                  "Add the missing rows; a table is not continued beyond its ends"));
  }

  LinearTable table_;
  std::string file_;
  char argument_ = 't';
};

}  // namespace

Function Function::from_expression(const std::string& text, const UnitConverter& unit, const ValueRule& rule) {
  Function function;
  try {
    function.form_ = std::make_shared<Formula>(text, unit, rule);
  } catch (const ExpressionError& error) {
    throw InputError(
        rule.problem(text, fmt::format("must be a formula in x, y, z and t; {}", error.what()), error.suggestion()));
  }
  if (function.varies_in_place() || function.varies_in_time()) return function;
  return function(Eigen::Vector3d::Zero(), 0);
}

Function Function::from_table(const std::filesystem::path& file, const ValueRule& rule) {
  const std::vector<Argument> arguments{
      {"time", quantity::time}, {"x", quantity::length}, {"y", quantity::length}, {"z", quantity::length}};
  Function function;
  function.form_ = std::make_shared<Tabulated>(read_table(file, arguments, rule), file.string(), rule);
  return function;
}

Function Function::from_table(LinearTable table, const ValueRule& rule) {
  Function function;
  function.form_ = std::make_shared<Tabulated>(ReadTable{"time", std::move(table)}, "", rule);
  return function;
}

double Function::operator()(const Eigen::Vector3d& place, double time) const {
  return form_ ? form_->value(place, time) : constant_;
}

bool Function::varies_in_time() const {
  return form_ && form_->varies('t');
}

bool Function::varies_in_place() const {
  return form_ && (form_->varies('x') || form_->varies('y') || form_->varies('z'));
}

bool Function::may_jump() const {
  return form_ && form_->may_jump();
}

std::optional<double> Function::constant() const {
  return form_ ? std::nullopt : std::optional(constant_);
}

std::optional<std::size_t> Function::bends_between(double begin, double end) const {
  return form_ ? form_->bends_between(begin, end) : 0;
}

void Function::check_time(double begin, double end) const {
  if (form_) form_->check_time(begin, end);
}

}  // namespace scree
