#include "engine/base/check_values.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "engine/base/expression.h"
#include "engine/base/nearest.h"

namespace scree {

namespace {

using Kind = InputValue::Kind;

// Who wrote one number need not hear of the other forms.
Key as_single(Key key) {
  key.depends = key.type == KeyType::quantity ? Depends::on_nothing : key.depends;
  if (key.count == Count::one_or_per_dimension) key.count = Count::one;
  return key;
}

// What is wrong with one value, and the checked value it belongs to.
struct Place {
  const Key& key;
  int dimension;
  Checked& checked;
  std::vector<Problem>& problems;

  void refuse(const InputValue& value, const std::string& reason, const std::string& suggestion) const {
    std::string rule = rule_words(value.kind == Kind::scalar ? as_single(key) : key, dimension);
    if (!reason.empty()) rule += "; " + reason;
    problems.push_back({value.where, checked.path, describe(value), rule, suggestion});
    checked.sound = false;
  }
};

// "-2.0" for something positive is often only the sign.
std::string without_sign(const InputValue& value, const Key& key, double number) {
  if (number >= 0 || !key.range.holds(-number) || value.text.empty() || value.text.front() != '-') return {};
  return fmt::format("Did you mean {}?", value.text.substr(1));
}

// A formula that stands where a number is looked for: it calculates with what the key depends on.
bool looks_like_formula(const std::string& text, const Key& key) {
  if (key.depends == Depends::on_nothing) return false;
  const std::vector<std::string> arguments =
      key.depends == Depends::on_temperature ? std::vector<std::string>{"T"} : std::vector<std::string>{"x", "y", "z", "t"};
  try {
    const Expression formula(text, arguments);
    return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& name) { return formula.uses(name); });
  } catch (const ExpressionError&) {
    return false;
  }
}

double quantity_value(const InputValue& value, const Place& place) {
  const auto parsed = parse_quantity(value.text, place.key.quantity);
  if (const auto* problem = std::get_if<UnitProblem>(&parsed)) {
    if (looks_like_formula(value.text, place.key)) {
      place.refuse(value, "", fmt::format("Write a formula as {{expression: \"{}\"}}", value.text));
    } else {
      place.refuse(value, problem->reason, problem->suggestion);
    }
    return 0;
  }
  const double number = std::get<double>(parsed);
  if (place.key.range.holds(number)) return number;
  place.refuse(value, "", without_sign(value, place.key, number));
  return 0;
}

// Kept as a double, which holds every integer up to 2^53.
double integer_value(const InputValue& value, const Place& place) {
  constexpr long long largest = 1LL << 53;
  const std::string& text = value.text;
  long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = end == text.data() + text.size() && !text.empty();
  if (error == std::errc::result_out_of_range || (whole && (number > largest || number < -largest))) {
    place.refuse(value, "too large", "");
  } else if (error != std::errc{} || !whole) {
    place.refuse(value, "", "");
  } else if (!place.key.range.holds(static_cast<double>(number))) {
    place.refuse(value, "", without_sign(value, place.key, static_cast<double>(number)));
  } else {
    return static_cast<double>(number);
  }
  return 0;
}

double one_number(const InputValue& value, const Place& place) {
  if (value.kind != Kind::scalar) {
    place.refuse(value, "", "");
    return 0;
  }
  return place.key.type == KeyType::integer ? integer_value(value, place) : quantity_value(value, place);
}

// One number of a list.
void add_item(const InputValue& value, Key key, const std::string& path, const Place& place) {
  key.count = Count::one;
  key.depends = Depends::on_nothing;
  Checked item;
  item.path = path;
  check_value(value, key, place.dimension, item, place.problems);
  place.checked.texts.push_back(item.text);
  place.checked.numbers.push_back(item.number());
  place.checked.sound = place.checked.sound && item.sound;
}

void check_numbers(const InputValue& value, const Place& place) {
  Checked& checked = place.checked;
  const bool single = place.key.count == Count::one_or_per_dimension && value.kind != Kind::list;
  if (place.key.count == Count::one || single) {
    checked.text = value.text;
    checked.numbers = {one_number(value, place)};
    return;
  }
  const auto wanted = static_cast<std::size_t>(place.key.count == Count::four ? 4 : place.dimension);
  checked.numbers.assign(wanted, 0);
  if (value.kind != Kind::list || value.items.size() != wanted) {
    const bool is_list = value.kind == Kind::list;
    place.refuse(value, is_list ? fmt::format("it has {}", value.items.size()) : "", "");
    return;
  }
  checked.numbers.clear();
  for (std::size_t i = 0; i < wanted; ++i) add_item(value.items[i], place.key, fmt::format("{}[{}]", checked.path, i), place);
}

// A table's argument is above the one before.
void check_order(const InputValue& pair, const Place& place) {
  const std::vector<double>& numbers = place.checked.numbers;
  const std::size_t count = numbers.size();
  if (!place.checked.sound || count < 4 || numbers[count - 2] > numbers[count - 4]) return;
  place.problems.push_back({pair.items.front().where, place.checked.path, describe(pair.items.front()),
                            "must be above the one before", "A jump is two places close together"});
  place.checked.sound = false;
}

// A file's name, or pairs of numbers: `texts` and `numbers` hold argument and value in turn.
void check_table(const InputValue& value, const Place& place) {
  Checked& checked = place.checked;
  if (value.kind == Kind::scalar && !value.text.empty()) {
    checked.text = value.text;
    return;
  }
  if (value.kind != Kind::list || value.items.empty()) return place.refuse(value, "", "");
  Key argument = place.key;
  argument.type = KeyType::quantity;
  Key result = argument;
  argument.quantity = argument_of(place.key);
  argument.range = {};
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const InputValue& pair = value.items[i];
    if (pair.kind != Kind::list || pair.items.size() != 2) return place.refuse(pair, "", "");
    add_item(pair.items[0], argument, fmt::format("{}[{}][0]", checked.path, i), place);
    add_item(pair.items[1], result, fmt::format("{}[{}][1]", checked.path, i), place);
    check_order(pair, place);
  }
}

void check_flag(const InputValue& value, const Place& place) {
  std::string lower = value.text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  place.checked.numbers = {lower == "true" ? 1.0 : 0.0};
  if (value.text == "true" || value.text == "false") return;
  const bool yes = lower == "true" || lower == "yes" || lower == "on" || lower == "1";
  const bool no = lower == "false" || lower == "no" || lower == "off" || lower == "0";
  place.refuse(value, "", yes || no ? fmt::format("Did you mean {}?", yes) : "");
}

void check_word(const InputValue& value, const Place& place) {
  const auto& words = place.key.words;
  if (std::find(words.begin(), words.end(), value.text) != words.end()) return;
  const auto meant = nearest(value.text, words);
  place.refuse(value, "", meant ? fmt::format("Did you mean {}?", *meant) : "");
}

}  // namespace

bool is_plain_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  return !name.empty() && letter(name.front()) && std::all_of(name.begin(), name.end(), inner);
}

void check_value(const InputValue& value, const Key& key, int dimension, Checked& checked, std::vector<Problem>& problems) {
  const Place place{key, dimension, checked, problems};
  checked.sound = true;
  if (key.type == KeyType::quantity || key.type == KeyType::integer) return check_numbers(value, place);
  if (key.type == KeyType::table) return check_table(value, place);
  checked.text = value.text;
  if (value.kind != Kind::scalar) return place.refuse(value, "", "");
  if (key.type == KeyType::flag) return check_flag(value, place);
  if (key.type == KeyType::word) return check_word(value, place);
  if (value.text.empty() && key.type != KeyType::text) return place.refuse(value, "", "");
}

}  // namespace scree
