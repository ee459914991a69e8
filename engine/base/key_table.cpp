#include "engine/base/key_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/check.h"

namespace scree {

namespace {

std::string item_words(const Key& key) {
  const std::string range = key.range.words();
  const std::string unit = key.quantity.unit.empty() ? "" : fmt::format(", {}", key.quantity.unit);
  if (key.type == KeyType::integer) return range.empty() ? "a whole number" : fmt::format("a whole number, {}", range);
  const bool vowel = std::string_view("aeiou").find(key.quantity.name.front()) != std::string_view::npos;
  if (range.empty()) return fmt::format("{} {}{}", vowel ? "an" : "a", key.quantity.name, unit);
  return range + unit;
}

std::string number_words(const Key& key, int dimension) {
  if (key.count == Count::one) return item_words(key);
  const std::string many = key.count == Count::four ? "4" : (dimension == 0 ? "2 or 3" : std::to_string(dimension));
  if (key.count == Count::one_or_per_dimension) return fmt::format("{}, once or in a list of {}", item_words(key), many);
  return fmt::format("a list of {}, each {}", many, item_words(key));
}

std::string other_forms(const Key& key) {
  if (key.depends == Depends::on_nothing) return {};
  return fmt::format("; or {{expression, unit}} in {}, or {{table}}",
                     key.depends == Depends::on_temperature ? "T" : "x, y, z, t");
}

// The keys of the other forms of a quantity, as if they stood in the table below it.
std::vector<Key> implied_keys(const Key& key) {
  const bool thermal = key.depends == Depends::on_temperature;
  Key expression;
  expression.path = key.path + ".expression";
  expression.type = KeyType::text;
  expression.meaning = thermal ? "A formula in T [K]." : "A formula in x, y, z [m] and t [s].";
  expression.required = true;
  expression.choice = "form";
  expression.implied = true;
  Key unit = expression;
  unit.path = key.path + ".unit";
  unit.meaning = "Unit of the formula's value.";
  unit.required = false;
  unit.choice.clear();
  unit.otherwise = key.quantity.unit.empty() ? "a plain number" : key.quantity.unit;
  unit.only = {Condition{expression.path}};
  Key table = expression;
  table.path = key.path + ".table";
  table.type = KeyType::table;
  table.meaning = thermal ? "Over temperature: a CSV file, or a list of pairs; linear in between and constant beyond."
                          : "Over time (a file: or x, y, z): a CSV file, or a list of pairs; linear in between.";
  table.quantity = key.quantity;
  table.range = key.range;
  table.depends = key.depends;
  return {expression, unit, table};
}

std::vector<Key> with_implied(std::vector<Key> keys) {
  std::vector<Key> all;
  for (Key& key : keys) {
    const bool more = key.type == KeyType::quantity && key.depends != Depends::on_nothing;
    std::vector<Key> implied = more ? implied_keys(key) : std::vector<Key>{};
    all.push_back(std::move(key));
    for (Key& child : implied) all.push_back(std::move(child));
  }
  return all;
}

std::string entry_words(const Key& key, std::string_view what) {
  if (key.range.low < 1) return fmt::format("a {}", what);
  if (key.range.low == key.range.high) return fmt::format("a {} of {}", what, key.range.low);
  return fmt::format("a {}, at least {}", what, key.range.low);
}

}  // namespace

std::string Condition::words() const {
  if (word.empty()) return fmt::format("{} {}", absent ? "without" : "with", key);
  return fmt::format("{} {}: {}", absent ? "without" : "with", key, word);
}

const KeyNode* KeyNode::find(std::string_view name) const {
  for (const auto& [child_name, child] : children) {
    if (child_name == name) return child.get();
  }
  return nullptr;
}

std::vector<std::string> KeyNode::names() const {
  std::vector<std::string> all;
  for (const auto& [name, child] : children) all.push_back(name);
  return all;
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts{""};
  for (const char c : path) {
    if (c == '.' || c == '[') parts.emplace_back();
    if (c != '.') parts.back() += c;
  }
  return parts;
}

Quantity argument_of(const Key& key) {
  return key.depends == Depends::on_temperature ? quantity::temperature : quantity::time;
}

KeyTable::KeyTable(std::vector<Key> keys) : keys_(with_implied(std::move(keys))) {
  for (const Key& key : keys_) {
    KeyNode* node = &root_;
    const std::vector<std::string> parts = split_path(key.path);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      auto* next = const_cast<KeyNode*>(node->find(parts[i]));
      if (next == nullptr) {
        SCREE_EXPECT(i + 1 == parts.size());
        node->children.emplace_back(parts[i], std::make_unique<KeyNode>());
        next = node->children.back().second.get();
      }
      node = next;
    }
    SCREE_EXPECT(node->key == nullptr);
    node->key = &key;
  }
}

const Key* KeyTable::find(std::string_view path) const {
  const KeyNode* node = &root_;
  for (const std::string& part : split_path(path)) {
    node = node->find(part);
    if (node == nullptr) return nullptr;
  }
  return node->key;
}

std::string rule_words(const Key& key, int dimension) {
  switch (key.type) {
    case KeyType::section:
      return "must be a map of keys";
    case KeyType::names:
      return "must be " + entry_words(key, "map of names");
    case KeyType::list:
      return "must be " + entry_words(key, "list");
    case KeyType::quantity:
    case KeyType::integer:
      return "must be " + number_words(key, dimension) + other_forms(key);
    case KeyType::flag:
      return "must be true or false";
    case KeyType::word:
      return fmt::format("must be one of {}", fmt::join(key.words, ", "));
    case KeyType::name:
      return "must be a name";
    case KeyType::text:
      return "must be text";
    case KeyType::path:
      return "must be a file";
    case KeyType::table: {
      const Quantity argument = argument_of(key);
      return fmt::format("must be a CSV file, or a list of pairs of {} [{}] and {}", argument.name, argument.unit,
                         item_words(key));
    }
  }
  return {};
}

}  // namespace scree
