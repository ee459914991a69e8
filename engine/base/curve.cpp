#include "engine/base/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

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
  [[nodiscard]] virtual double slope(double temperature) const = 0;
  [[nodiscard]] virtual double integral(double temperature) const = 0;
};

namespace {

class Tabulated : public Curve::Form {
 public:
  explicit Tabulated(LinearTable table) : table_(std::move(table)) {}
  [[nodiscard]] double value(double temperature) const override { return table_(temperature); }
  [[nodiscard]] double slope(double temperature) const override { return table_.slope(temperature); }
  [[nodiscard]] double integral(double temperature) const override { return table_.integral(temperature); }

 private:
  LinearTable table_;
};

// Gauss-Legendre with five points (Abramowitz and Stegun, 25.4.30 and table 25.4), from -1 to 1.
constexpr std::size_t gauss_count = 5;
constexpr std::array gauss_points{-0.906179845938663993, -0.538469310105683091, 0.0, 0.538469310105683091,
                                  0.906179845938663993};
constexpr std::array gauss_weights{0.236926885056189088, 0.478628670499366468, 0.568888888888888889, 0.478628670499366468,
                                   0.236926885056189088};

// A formula between two temperatures: the polynomial through its values at Gauss's points, whose integral is that of Gauss's
// rule, and so exact where the formula is of the ninth degree.
class Piece {
 public:
  Piece(double from, double to, const std::array<double, gauss_count>& values)
      : centre_(0.5 * (from + to)), inverse_(2 / (to - from)) {
    // Newton's divided differences, then powers of s = (T - centre)/half.
    std::array<double, gauss_count> differences = values;
    for (std::size_t order = 1; order < gauss_count; ++order) {
      for (std::size_t i = gauss_count - 1; i >= order; --i) {
        differences[i] = (differences[i] - differences[i - 1]) / (gauss_points[i] - gauss_points[i - order]);
      }
    }
    for (std::size_t i = gauss_count; i-- > 0;) {
      for (std::size_t power = gauss_count - 1; power > 0; --power) {
        powers_[power] = powers_[power - 1] - gauss_points[i] * powers_[power];
      }
      powers_[0] = differences[i] - gauss_points[i] * powers_[0];
    }
    const double half = 0.5 * (to - from);
    for (std::size_t i = 0; i < gauss_count; ++i) {
      rises_[i + 1] = half * powers_[i] / static_cast<double>(i + 1);
      whole_ += half * gauss_weights[i] * values[i];
    }
    rises_[0] = -polynomial(rises_, -1);
  }

  [[nodiscard]] double value(double temperature) const { return polynomial(powers_, (temperature - centre_) * inverse_); }

  [[nodiscard]] double slope(double temperature) const {
    const double s = (temperature - centre_) * inverse_;
    double sum = 0;
    for (std::size_t power = gauss_count; power-- > 1;) sum = sum * s + static_cast<double>(power) * powers_[power];
    return sum * inverse_;
  }

  // From its beginning to its end, or to a temperature.
  [[nodiscard]] double whole() const { return whole_; }
  [[nodiscard]] double integral_to(double temperature) const { return polynomial(rises_, (temperature - centre_) * inverse_); }

 private:
  template <std::size_t count>
  static double polynomial(const std::array<double, count>& powers, double s) {
    double sum = 0;
    for (std::size_t power = count; power-- > 0;) sum = sum * s + powers[power];
    return sum;
  }

  double centre_, inverse_;                      // and 1 over half of its length
  std::array<double, gauss_count> powers_{};     // of its value
  std::array<double, gauss_count + 1> rises_{};  // of the integral from its beginning
  double whole_ = 0;
};

// muParser reads the formula once and is then slow: what it gives is kept piece by piece, each kelvin one piece or more.
class Formula : public Curve::Form {
 public:
  Formula(const std::string& text, UnitConverter unit, ValueRule rule)
      : expression_(text, {"T"}), unit_(std::move(unit)), rule_(std::move(rule)), text_(text) {}

  [[nodiscard]] bool varies() const { return expression_.uses("T"); }

  [[nodiscard]] double value(double temperature) const override {
    const Kept* kept = kept_at(temperature);
    const double result = kept != nullptr && kept->smooth ? kept->piece.value(temperature) : raw(temperature);
    if (!rule_.holds(result)) refuse(result, temperature);
    return result;
  }

  [[nodiscard]] double slope(double temperature) const override {
    const Kept* kept = kept_at(temperature);
    return kept != nullptr && kept->smooth ? kept->piece.slope(temperature) : 0;
  }

  [[nodiscard]] double integral(double temperature) const override {
    const Kept* kept = kept_at(temperature);
    const double result = kept == nullptr ? integral_below_zero(temperature)
                          : kept->smooth  ? kept->before + kept->piece.integral_to(temperature)
                                          : kept->before + through(kept->begin, temperature).whole();
    if (!std::isfinite(result)) refuse(result, temperature);
    return result;
  }

 private:
  // Of what is cut at first, and of what is cut where something is as hot.
  static constexpr int last_kelvin = 5000;
  static constexpr int last_hot_kelvin = 50000;
  // How often a kelvin may be halved, and into how many pieces in all: a formula that jumps needs as many as halvings.
  static constexpr int most_halvings = 40;
  static constexpr std::size_t most_pieces = 2000;
  // Where the rule over a whole and over its halves differ by more than this share, or the polynomial and the formula by more
  // than that and what the rounding of temperatures makes, the formula is not smooth there.
  static constexpr double smooth_integral = 1e-12;
  static constexpr double smooth_value = 1e-11;
  // What jumps, bends or peaks may do so between Gauss's points, and is looked at from one end to the other [K].
  static constexpr double look_apart = 0.02;

  struct Kept {
    double begin;   // [K]
    double before;  // integral from the reference to there
    bool smooth;    // or the formula itself is asked
    Piece piece;
  };

  // Pieces of some kelvins, ascending.
  struct Kelvins {
    int first;
    int last;
    std::once_flag once{};
    std::vector<Kept> kept{};
    std::vector<std::size_t> first_of_kelvin{};  // of these, and their number
    std::vector<double> rises{};                 // of the integral over each, while they are cut
    double to_last = 0;                          // integral from the reference to the end of the last
  };

  [[nodiscard]] double raw(double temperature) const { return unit_(expression_(std::array{temperature})); }

  [[nodiscard]] Piece through(double from, double to) const {
    std::array<double, gauss_count> values;
    for (std::size_t i = 0; i < gauss_count; ++i) values[i] = raw(0.5 * (from + to) + 0.5 * (to - from) * gauss_points[i]);
    return {from, to, values};
  }

  // Nothing below 0 K.
  [[nodiscard]] const Kept* kept_at(double temperature) const {
    if (!(temperature >= 0)) return nullptr;
    const Kelvins& kelvins = kelvins_at(temperature);
    const auto kelvin = static_cast<std::size_t>(temperature) - static_cast<std::size_t>(kelvins.first);
    const Kept* first = kelvins.kept.data() + kelvins.first_of_kelvin[kelvin];
    const Kept* last = kelvins.kept.data() + kelvins.first_of_kelvin[kelvin + 1];
    if (last - first == 1) return first;
    return std::upper_bound(first, last, temperature, [](double at, const Kept& kept) { return at < kept.begin; }) - 1;
  }

  [[nodiscard]] const Kelvins& kelvins_at(double temperature) const {
    std::call_once(usual_.once, [&] {
      cut(usual_);
      sum_up(usual_, first_summed(), 0);
    });
    if (temperature < last_kelvin) return usual_;
    if (!(temperature < last_hot_kelvin)) {
      throw InputError(
          rule_.problem(text_, fmt::format("must be asked for below {} K, and is at {:g} K", last_hot_kelvin, temperature),
                        "Look for what heats so much, or give a table"));
    }
    std::call_once(hot_.once, [&] {
      cut(hot_);
      sum_up(hot_, 0, usual_.to_last);
    });
    return hot_;
  }

  [[nodiscard]] double integral_below_zero(double temperature) const {
    return kelvins_at(0).kept.front().before + through(0, temperature).whole();
  }

  void cut(Kelvins& kelvins) const {
    for (int k = kelvins.first; k < kelvins.last; ++k) {
      kelvins.first_of_kelvin.push_back(kelvins.kept.size());
      room_ = most_pieces;
      append(k, k + 1, through(k, k + 1), most_halvings, kelvins);
    }
    kelvins.first_of_kelvin.push_back(kelvins.kept.size());
  }

  // A temperature that is usual.
  static constexpr std::size_t reference = 300;  // [K]

  // Where a formula all but vanishes towards 0 K, as T^3, sums from a usual temperature would drown differences there in their
  // rounding.
  [[nodiscard]] bool vanishes_at_zero() const {
    const auto sum = [&](std::size_t kelvin) {
      const auto begin = usual_.rises.begin();
      return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(usual_.first_of_kelvin[kelvin]), 0.0);
    };
    constexpr double of_a_constant = 1.0 / reference;
    return std::abs(sum(1)) < 0.3 * of_a_constant * std::abs(sum(reference));
  }

  // The piece that sums begin at, up and down: at a temperature that is usual, or the nearest to it at which there is a value.
  // Where a formula grows beyond all bounds towards 0 K, as 1/T^2, sums from there would drown all other differences.
  [[nodiscard]] std::size_t first_summed() const {
    if (vanishes_at_zero()) return 0;
    std::size_t start = usual_.first_of_kelvin[reference];
    for (int away = 0; away < last_kelvin && !std::isfinite(usual_.rises[start]); ++away) {
      const int kelvin = static_cast<int>(reference) + (away % 2 == 0 ? -away / 2 : away / 2 + 1);
      if (kelvin >= 0) start = usual_.first_of_kelvin[static_cast<std::size_t>(kelvin)];
    }
    return start;
  }

  // Up and down from the piece `start`, where the integral is this.
  static void sum_up(Kelvins& kelvins, std::size_t start, double integral) {
    double sum = integral;
    for (std::size_t i = start; i < kelvins.kept.size(); ++i) {
      kelvins.kept[i].before = sum;
      sum += kelvins.rises[i];
    }
    kelvins.to_last = sum;
    sum = integral;
    for (std::size_t i = start; i-- > 0;) {
      sum -= kelvins.rises[i];
      kelvins.kept[i].before = sum;
    }
    kelvins.rises.clear();
    kelvins.rises.shrink_to_fit();
  }

  // Pieces on each of which Gauss's rule is exact, so that the integral rises wherever the formula is positive.
  void append(double from, double to, const Piece& whole, int halvings, Kelvins& kelvins) const {
    const double middle = 0.5 * (from + to);
    const Piece left = through(from, middle), right = through(middle, to);
    const bool smooth = sums_up(whole, from, left, right, to) && follows(whole, from, left, middle, right, to) &&
                        holds_between_points(whole, from, to);
    const bool nowhere = !std::isfinite(whole.whole()) && valueless(from, middle) && valueless(middle, to);
    if (!smooth && !nowhere && halvings > 0 && room_ > 0) {
      --room_;
      append(from, middle, left, halvings - 1, kelvins);
      append(middle, to, right, halvings - 1, kelvins);
      return;
    }
    kelvins.kept.push_back({from, 0, smooth, whole});
    kelvins.rises.push_back(smooth ? whole.whole() : left.whole() + right.whole());
  }

  // Whether the formula has no value at any of Gauss's points.
  [[nodiscard]] bool valueless(double from, double to) const {
    return std::none_of(gauss_points.begin(), gauss_points.end(),
                        [&](double s) { return std::isfinite(raw(0.5 * (from + to) + 0.5 * (to - from) * s)); });
  }

  // What a value may be off by, because its temperature is rounded.
  static double noise(const Piece& piece, double temperature) {
    constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();
    return roundings * temperature * std::abs(piece.slope(temperature));
  }

  // Whether the polynomial gives this value at a temperature.
  static bool gives(const Piece& piece, double temperature, double value) {
    return std::abs(piece.value(temperature) - value) <= smooth_value * std::abs(value) + noise(piece, temperature);
  }

  // Whether the integral of a whole is that of its halves.
  static bool sums_up(const Piece& whole, double from, const Piece& left, const Piece& right, double to) {
    const double size = std::abs(left.whole()) + std::abs(right.whole());
    return std::abs(left.whole() + right.whole() - whole.whole()) <=
           smooth_integral * size + std::max(noise(whole, from), noise(whole, to)) * (to - from);
  }

  // Whether the polynomial of a whole gives what those of its halves do.
  static bool follows(const Piece& whole, double from, const Piece& left, double middle, const Piece& right, double to) {
    const auto same = [&](const Piece& half, double temperature) { return gives(whole, temperature, half.value(temperature)); };
    bool all = true;
    for (const double s : {0.0, 0.3, 0.7, 1.0}) {
      all = all && same(left, from + s * (middle - from)) && same(right, middle + s * (to - middle));
    }
    return all;
  }

  // Whether the polynomial gives what the formula does, at its ends and in between.
  [[nodiscard]] bool holds_between_points(const Piece& whole, double from, double to) const {
    const double end = std::nextafter(to, from);  // at `to` the next piece begins
    const int looks = static_cast<int>(std::ceil((to - from) / look_apart));
    for (int i = 0; i <= looks; ++i) {
      const double temperature = i == looks ? end : from + i * ((to - from) / looks);
      if (!gives(whole, temperature, raw(temperature))) return false;
    }
    return true;
  }

  [[noreturn]] void refuse(double value, double temperature) const {
    throw InputError(rule_.problem(fmt::format("{:g} {} at {:g} K", value, rule_.quantity.unit, temperature),
                                   "must be " + rule_.words(), fmt::format("The formula is {}", text_)));
  }

  Expression expression_;
  UnitConverter unit_;
  ValueRule rule_;
  std::string text_;
  mutable Kelvins usual_{.first = 0, .last = last_kelvin};
  mutable Kelvins hot_{.first = last_kelvin, .last = last_hot_kelvin};
  mutable std::size_t room_ = 0;  // pieces that a kelvin may still be cut into
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

double Curve::slope(double temperature) const {
  return form_ ? form_->slope(temperature) : 0;
}

double Curve::integral(double temperature) const {
  return form_ ? form_->integral(temperature) : constant_ * temperature;
}

std::optional<double> Curve::constant() const {
  return form_ ? std::nullopt : std::optional(constant_);
}

}  // namespace scree
