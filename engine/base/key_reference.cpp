#include "engine/base/key_reference.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scree {

namespace {

// Key, value, default, meaning.
using Row = std::array<std::string, 4>;

std::string without_must_be(const std::string& rule) {
  constexpr std::string_view lead = "must be ";
  return rule.starts_with(lead) ? rule.substr(lead.size()) : rule;
}

std::string meaning(const Key& key) {
  std::string text = key.meaning;
  if (!key.choice.empty() && !key.required) text += fmt::format(" At most one {}.", key.choice);
  std::vector<std::string> conditions;
  for (const Condition& condition : key.only) conditions.push_back(condition.words());
  if (!conditions.empty()) text += fmt::format(" Only {}.", fmt::join(conditions, ", "));
  return text;
}

std::string fallback(const Key& key) {
  if (!key.choice.empty()) return key.required ? fmt::format("one {} needed", key.choice) : "-";
  if (key.required) return "required";
  if (!key.otherwise.empty()) return key.otherwise;
  return key.fallback.empty() || key.fallback == "{}" ? "-" : key.fallback;
}

std::string section(const std::string& path) {
  return path.substr(0, path.find_first_of(".["));
}

}  // namespace

std::string key_reference(const KeyTable& table, std::string_view prefix) {
  std::vector<Row> rows;
  for (const Key& key : table.keys()) {
    if (key.path.starts_with(prefix) && !key.implied) {
      rows.push_back({key.path, without_must_be(rule_words(key, 0)), fallback(key), meaning(key)});
    }
  }
  if (rows.empty()) return {};
  const Row heads{"key", "value", "default", "meaning"};
  std::array<std::size_t, 4> widths{};
  for (std::size_t i = 0; i < heads.size(); ++i) {
    widths[i] = heads[i].size();
    for (const Row& row : rows) widths[i] = std::max(widths[i], row[i].size());
  }
  const auto line = [&](const Row& row) {
    return fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", row[0], widths[0], row[1], widths[1], row[2], widths[2], row[3]);
  };
  std::string text = line(heads);
  std::string last;
  for (const Row& row : rows) {
    if (section(row[0]) != last) text += '\n';
    last = section(row[0]);
    text += line(row);
  }
  return text;
}

}  // namespace scree
