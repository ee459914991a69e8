#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/check.h"
#include "engine/base/check_values.h"
#include "engine/base/checked_input.h"
#include "engine/base/nearest.h"

namespace scree {

namespace {

using Kind = InputValue::Kind;

std::string how_many(std::size_t items) {
  return items == 0 ? "empty" : fmt::format("a list of {}", items);
}

std::string joined(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

// The table's order, so that equal scenes give equal effective scenes.
void sort_entries(const KeyNode& node, std::vector<CheckedEntry>& entries) {
  const std::vector<std::string> names = node.names();
  const auto rank = [&](const CheckedEntry& entry) { return std::find(names.begin(), names.end(), entry.name); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const CheckedEntry& a, const CheckedEntry& b) { return rank(a) < rank(b); });
}

class Checker {
 public:
  Checker(const KeyTable& table, const InputValue& root, int dimension, std::vector<Problem>& problems)
      : table_(table), root_(root), dimension_(dimension), problems_(problems) {}

  Checked check(const InputValue& value, const KeyNode& node, const std::string& path) {
    Checked checked;
    checked.key = node.key;
    checked.path = path;
    checked.where = value.where;
    const KeyType type = node.key == nullptr ? KeyType::section : node.key->type;
    const bool map_of_keys = value.kind == Kind::map && !node.children.empty();
    if (type == KeyType::list) {
      check_list(value, node, checked);
    } else if (type == KeyType::section || type == KeyType::names || map_of_keys) {
      check_map(value, node, checked);
    } else {
      check_value(value, *node.key, dimension_, checked, problems_);
    }
    return checked;
  }

 private:
  void refuse(const Checked& checked, const std::string& value) {
    const std::string rule = checked.key == nullptr ? "must be a map of keys" : rule_words(*checked.key, dimension_);
    problems_.push_back(checked.problem(value, rule));
  }

  void check_list(const InputValue& value, const KeyNode& node, Checked& checked) {
    if (value.kind != Kind::list) return refuse(checked, describe(value));
    checked.sound = true;
    if (!node.key->range.holds(static_cast<double>(value.items.size()))) return refuse(checked, how_many(value.items.size()));
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      checked.items.push_back(check(value.items[i], *node.children.front().second, fmt::format("{}[{}]", checked.path, i)));
    }
  }

  void check_map(const InputValue& value, const KeyNode& node, Checked& checked) {
    checked.is_map = true;
    // `settle:` with nothing behind it asks for the section with its defaults.
    const bool mapping = value.kind == Kind::map || value.kind == Kind::empty;
    if (!mapping) return refuse(checked, describe(value));
    checked.sound = true;
    const KeyNode* any = node.find("*");
    if (any != nullptr && !holds_keys(value, node)) return check_names(value, *any, checked);
    for (const InputEntry& entry : value.entries) check_entry(entry, node, checked);
    check_choices(value, node, checked);
    for (const auto& [name, child] : node.children) {
      if (name != "*") fill_in(value, name, *child, checked);
    }
    sort_entries(node, checked.entries);
  }

  // A map of the keys below, where names the user chooses could stand as well.
  static bool holds_keys(const InputValue& value, const KeyNode& node) {
    if (node.children.size() == 1 || value.entries.empty()) return false;
    return std::all_of(value.entries.begin(), value.entries.end(),
                       [&](const InputEntry& entry) { return entry.name != "*" && node.find(entry.name) != nullptr; });
  }

  void check_names(const InputValue& value, const KeyNode& any, Checked& checked) {
    const auto count = static_cast<double>(value.entries.size());
    if (checked.key->type == KeyType::names && !checked.key->range.holds(count))
      refuse(checked, how_many(value.entries.size()));
    for (const InputEntry& entry : value.entries) {
      const std::string path = joined(checked.path, entry.name);
      if (!is_plain_name(entry.name)) {
        problems_.push_back({entry.where, path, "no name", "letters, digits, _ and -, not beginning with a digit", ""});
        continue;
      }
      checked.entries.push_back({entry.name, entry.where, check(entry.value, any, path)});
    }
  }

  void check_entry(const InputEntry& entry, const KeyNode& node, Checked& checked) {
    const std::string path = joined(checked.path, entry.name);
    const KeyNode* child = node.find(entry.name);
    if (child == nullptr) {
      const std::string rule = checked.path.empty() ? "no key of the file" : fmt::format("no key of {}", checked.path);
      problems_.push_back({entry.where, path, "unknown", rule, suggest(entry.name, node.names())});
      return;
    }
    const Condition* unmet = first_unmet(*child->key, path);
    if (unmet != nullptr) {
      problems_.push_back(
          {entry.where, path, "without use", fmt::format("of use only {}", words(*unmet, path)), "Take it out"});
      return;
    }
    checked.entries.push_back({entry.name, entry.where, check(entry.value, *child, path)});
  }

  // Exactly one, or at most one, of the keys that make a choice.
  void check_choices(const InputValue& value, const KeyNode& node, const Checked& checked) {
    std::vector<std::string> done;
    for (const auto& [name, child] : node.children) {
      const std::string& choice = child->key->choice;
      if (choice.empty() || std::find(done.begin(), done.end(), choice) != done.end()) continue;
      done.push_back(choice);
      check_choice(value, node, *child->key, checked);
    }
  }

  void check_choice(const InputValue& value, const KeyNode& node, const Key& first, const Checked& checked) {
    std::vector<std::string> names;
    for (const auto& [name, child] : node.children) {
      if (child->key->choice == first.choice) names.push_back(name);
    }
    std::vector<const InputEntry*> given;
    for (const InputEntry& entry : value.entries) {
      if (std::find(names.begin(), names.end(), entry.name) != names.end()) given.push_back(&entry);
    }
    const std::string rule =
        fmt::format("must have {} one of {}", first.required ? "exactly" : "at most", fmt::join(names, ", "));
    if (given.empty() && first.required) {
      problems_.push_back(checked.problem(fmt::format("without a {}", first.choice), rule));
    }
    for (std::size_t i = 1; i < given.size(); ++i) {
      const std::string beside = fmt::format("given beside {}", given.front()->name);
      problems_.push_back({given[i]->where, joined(checked.path, given[i]->name), beside, rule, "Keep one of them"});
    }
  }

  // A missing key: its default, or a problem.
  void fill_in(const InputValue& value, const std::string& name, const KeyNode& child, Checked& checked) {
    if (value.find(name) != nullptr) return;
    const Key& key = *child.key;
    const std::string path = joined(checked.path, name);
    if (first_unmet(key, path) != nullptr) return;
    if (!key.fallback.empty()) {
      InputValue fallback = parse_yaml(key.fallback, "default of " + key.path);
      Checked filled = check(fallback, child, path);
      filled.given = false;
      filled.where = checked.where;
      checked.entries.push_back({name, checked.where, std::move(filled)});
    } else if (key.required && key.choice.empty()) {
      problems_.push_back({checked.where, path, "missing", rule_words(key, dimension_), ""});
    }
  }

  [[nodiscard]] const Condition* first_unmet(const Key& key, const std::string& path) const {
    for (const Condition& condition : key.only) {
      if (!holds(condition, path)) return &condition;
    }
    return nullptr;
  }

  // The condition's key with the names and items of `path`.
  [[nodiscard]] static std::vector<std::string> bound_path(const Condition& condition, const std::string& path) {
    std::vector<std::string> parts = split_path(condition.key);
    const std::vector<std::string> actual = split_path(path);
    for (std::size_t i = 0; i < parts.size() && i < actual.size(); ++i) {
      if (parts[i] == "*" || parts[i] == "[]") parts[i] = actual[i];
    }
    return parts;
  }

  static std::string words(Condition condition, const std::string& path) {
    std::string bound;
    for (const std::string& part : bound_path(condition, path))
      bound += part.starts_with("[") || bound.empty() ? part : "." + part;
    condition.key = bound;
    return condition.words();
  }

  // Also a word's default counts, unless its section is missing.
  [[nodiscard]] bool holds(const Condition& condition, const std::string& path) const {
    const InputValue* value = &root_;
    const std::vector<std::string> parts = bound_path(condition, path);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const InputValue* next = step(*value, parts[i]);
      const bool last = i + 1 == parts.size();
      if (next == nullptr && last && !condition.word.empty()) {
        const Key* key = table_.find(condition.key);
        return (key != nullptr && key->fallback == condition.word) != condition.absent;
      }
      if (next == nullptr) return condition.absent;
      value = next;
    }
    return (condition.word.empty() || value->text == condition.word) != condition.absent;
  }

  static const InputValue* step(const InputValue& value, const std::string& part) {
    if (part.front() != '[') return value.find(part);
    const auto index = static_cast<std::size_t>(std::stoul(part.substr(1)));
    return index < value.items.size() ? &value.items[index] : nullptr;
  }

  const KeyTable& table_;
  const InputValue& root_;
  int dimension_;
  std::vector<Problem>& problems_;
};

}  // namespace

const Checked* Checked::find(std::string_view name) const {
  for (const CheckedEntry& entry : entries) {
    if (entry.name == name) return &entry.value;
  }
  return nullptr;
}

const Checked& Checked::at(std::string_view name) const {
  static const Checked nothing;
  const Checked* value = find(name);
  return value == nullptr ? nothing : *value;
}

int Checked::integer() const {
  SCREE_EXPECT(std::abs(number()) <= std::numeric_limits<int>::max());
  return static_cast<int>(number());
}

Eigen::Vector3d Checked::vector() const {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < numbers.size() && i < 3; ++i) result[static_cast<Eigen::Index>(i)] = numbers[i];
  return result;
}

Problem Checked::problem(std::string value, std::string rule, std::string suggestion) const {
  return {where, path.empty() ? "the file" : path, std::move(value), std::move(rule), std::move(suggestion)};
}

void add_entries(Checked& map, const KeyTable& table, std::vector<CheckedEntry> more) {
  const KeyNode* node = &table.root();
  for (const std::string& part : split_path(map.path)) {
    node = node->find(part);
    SCREE_EXPECT(node != nullptr);
  }
  for (CheckedEntry& entry : more) map.entries.push_back(std::move(entry));
  sort_entries(*node, map.entries);
}

Checked check_input(const InputValue& input, const KeyTable& table, int dimension, std::vector<Problem>& problems) {
  return Checker(table, input, dimension, problems).check(input, table.root(), "");
}

}  // namespace scree
