// Numbers without a unit that are probably meant in another one than SI: 25 for a temperature, 45 for an angle.
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "engine/base/expression.h"
#include "tools/scene/suspicions.h"

namespace scree {

namespace {

constexpr double coldest_usual = 200;  // [K]; rock, ore and soil are warmer, and most temperatures in degC are below

bool is_bare(const std::string& text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text.back())) != 0 || text.back() == '.');
}

// The first that is suspicious: the others of a table are of its kind.
void judge_table(const Checked& table, Sentences& sentences) {
  for (std::size_t i = 0; i < table.texts.size(); ++i) {
    const bool is_argument = i % 2 == 0;
    const Quantity quantity = is_argument ? argument_of(*table.key) : table.key->quantity;
    const std::string path = fmt::format("{}[{}][{}]", table.path, i / 2, i % 2);
    if (auto sentence = bare_value(path, table.texts[i], table.numbers[i], quantity)) {
      sentences.push_back(std::move(*sentence));
      return;
    }
  }
}

// Where and when all its variables are zero.
std::optional<double> at_zero(const std::string& formula) {
  const std::vector<std::string> variables{"x", "y", "z", "t"};
  const std::array<double, 4> zero{};
  try {
    return Expression(formula, variables)(zero);
  } catch (const ExpressionError&) {
    return std::nullopt;  // its own message says why
  }
}

void judge_formula(const Checked& map, Sentences& sentences) {
  const Checked* formula = map.find("expression");
  if (formula == nullptr || map.find("unit") != nullptr || map.key->quantity.kind != Quantity::Kind::temperature) return;
  const std::optional<double> value = at_zero(formula->text);
  if (!value || !(*value < coldest_usual)) return;
  sentences.push_back(fmt::format(
      "{} is {:g} at the origin and time 0, which is in kelvin: give it `unit: degC` if that is meant", map.path, *value));
}

void look_at(const Checked& value, Sentences& sentences) {
  const bool given = value.key != nullptr && value.given && value.sound;
  if (given && value.key->type == KeyType::table) {
    judge_table(value, sentences);
  } else if (given && value.key->type == KeyType::quantity && value.is_map) {
    judge_formula(value, sentences);
  } else if (given && value.key->type == KeyType::quantity && value.numbers.size() == 1) {
    if (auto sentence = bare_value(value.path, value.text, value.number(), value.key->quantity))
      sentences.push_back(std::move(*sentence));
  }
  for (const CheckedEntry& entry : value.entries) look_at(entry.value, sentences);
  for (const Checked& item : value.items) look_at(item, sentences);
}

}  // namespace

std::optional<std::string> bare_value(const std::string& path, const std::string& text, double value,
                                      const Quantity& quantity) {
  if (!is_bare(text)) return std::nullopt;
  if (quantity.kind == Quantity::Kind::temperature && value < coldest_usual) {
    return fmt::format("{} is {}, which is in kelvin: write {} degC if that is meant", path, text, text);
  }
  if (quantity.unit == "rad" && std::abs(value) > 2 * std::numbers::pi) {
    return fmt::format("{} is {}, which is in radians: write {} deg if that is meant", path, text, text);
  }
  return std::nullopt;
}

Sentences bare_values(const Checked& checked) {
  Sentences sentences;
  look_at(checked, sentences);
  return sentences;
}

}  // namespace scree
