#include "engine/base/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "engine/base/expression.h"
#include "engine/base/table_file.h"

namespace scree {

struct Curve::Form {
  Form() = default;
  virtual ~Form() = default;
  Form(const Form&) = delete;
  Form& operator=(const Form&) = delete;

  [[nodiscard]] virtual double value(double temperature) const = 0;
  [[nodiscard]] virtual double integral(double temperature) const = 0;
  [[nodiscard]] virtual bool can_be_shared() const = 0;
};

namespace {

class Tabulated : public Curve::Form {
 public:
  explicit Tabulated(LinearTable table) : table_(std::move(table)) {}
  [[nodiscard]] double value(double temperature) const override { return table_(temperature); }
  [[nodiscard]] double integral(double temperature) const override { return table_.integral(temperature); }
  [[nodiscard]] bool can_be_shared() const override { return true; }

 private:
  LinearTable table_;
};

class Formula : public Curve::Form {
 public:
  Formula(const std::string& text, UnitConverter unit, ValueRule rule)
      : expression_(text, {"T"}), unit_(std::move(unit)), rule_(std::move(rule)), text_(text) {}

  [[nodiscard]] bool varies() const { return expression_.uses("T"); }

  [[nodiscard]] double value(double temperature) const override {
    const double result = raw(temperature);
    if (!rule_.holds(result)) refuse(result, temperature);
    return result;
  }

  [[nodiscard]] double integral(double temperature) const override {
    std::call_once(cut_, [&] { cut(); });
    const auto above = std::upper_bound(cuts_.begin(), cuts_.end(), std::max(temperature, 0.0));
    const auto piece = static_cast<std::size_t>(above - cuts_.begin()) - 1;
    const double result = sums_[piece] + gauss(cuts_[piece], temperature);
    if (!std::isfinite(result)) refuse(result, temperature);
    return result;
  }

  [[nodiscard]] bool can_be_shared() const override { return false; }

 private:
  // Sums are kept up to here; the way from here to a higher temperature is one interval of Gauss's rule.
  static constexpr int last_kelvin = 5000;
  // How often a kelvin may be halved, and into how many pieces in all: a formula that jumps needs as many as halvings.
  static constexpr int most_halvings = 40;
  static constexpr std::size_t most_pieces = 2000;
  // Where the rule over a whole and over its halves differ by more than this share, the formula is not smooth there.
  static constexpr double smooth = 1e-12;

  [[nodiscard]] double raw(double temperature) const { return unit_(expression_(std::array{temperature})); }

  // Gauss-Legendre with five points (Abramowitz and Stegun, 25.4.30 and table 25.4).
  [[nodiscard]] double gauss(double from, double to) const {
    constexpr std::array points{0.0, 0.538469310105683091, 0.906179845938663993};
    constexpr std::array weights{0.568888888888888889, 0.478628670499366468, 0.236926885056189088};
    const double centre = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    if (half == 0) return 0;
    double sum = weights[0] * raw(centre);
    for (std::size_t i = 1; i < points.size(); ++i) {
      sum += weights[i] * (raw(centre - half * points[i]) + raw(centre + half * points[i]));
    }
    return sum * half;
  }

  void cut() const {
    cuts_.push_back(0);
    sums_.push_back(0);
    for (int k = 0; k < last_kelvin; ++k) {
      room_ = most_pieces;
      append(k, k + 1, gauss(k, k + 1), most_halvings);
    }
  }

  // Pieces on each of which Gauss's rule is exact, so that the integral rises wherever the formula is positive.
  void append(double from, double to, double whole, int halvings) const {
    const double middle = 0.5 * (from + to);
    const double left = gauss(from, middle);
    const double right = gauss(middle, to);
    const bool rough = std::abs(left + right - whole) > smooth * (std::abs(left) + std::abs(right));
    if (rough && halvings > 0 && room_ > 0) {
      --room_;
      append(from, middle, left, halvings - 1);
      append(middle, to, right, halvings - 1);
      return;
    }
    cuts_.push_back(to);
    sums_.push_back(sums_.back() + left + right);
  }

  [[noreturn]] void refuse(double value, double temperature) const {
    throw InputError(rule_.problem(fmt::format("{:g} {} at {:g} K", value, rule_.quantity.unit, temperature),
                                   "must be " + rule_.words(), fmt::format("The formula is {}", text_)));
  }

  Expression expression_;
  UnitConverter unit_;
  ValueRule rule_;
  std::string text_;
  mutable std::once_flag cut_;
  mutable std::vector<double> cuts_;  // where pieces begin and end [K]
  mutable std::vector<double> sums_;  // integral from 0 K to each
  mutable std::size_t room_ = 0;      // pieces that a kelvin may still be cut into
};

}  // namespace

Curve Curve::from_expression(const std::string& text, const UnitConverter& unit, const ValueRule& rule) {
  try {
    const auto formula = std::make_shared<Formula>(text, unit, rule);
    if (!formula->varies()) return formula->value(0);
    Curve curve;
    curve.form_ = formula;
    return curve;
  } catch (const ExpressionError& error) {
    throw InputError(rule.problem(text, fmt::format("must be a formula in T; {}", error.what()), error.suggestion()));
  }
}

Curve Curve::from_table(LinearTable table) {
  Curve curve;
  curve.form_ = std::make_shared<Tabulated>(std::move(table));
  return curve;
}

Curve Curve::from_table(const std::filesystem::path& file, const ValueRule& rule) {
  return from_table(read_table(file, {{"temperature", quantity::temperature}}, rule).values);
}

double Curve::operator()(double temperature) const {
  return form_ ? form_->value(temperature) : constant_;
}

double Curve::integral(double temperature) const {
  return form_ ? form_->integral(temperature) : constant_ * temperature;
}

std::optional<double> Curve::constant() const {
  return form_ ? std::nullopt : std::optional(constant_);
}

bool Curve::can_be_shared() const {
  return !form_ || form_->can_be_shared();
}

}  // namespace scree
