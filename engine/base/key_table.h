// The accepted keys of an input file, declared once: checking, the printed reference and the JSON schema come from here.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/range.h"
#include "engine/base/units.h"

namespace scree {

// What stands under a key.
enum class KeyType {
  section,   // a map of the keys below it
  names,     // a map from names the user chooses
  list,      // items of one kind
  quantity,  // a number, maybe with a unit
  integer,
  flag,  // true or false
  word,  // one of a few
  name,  // refers to something the user named
  text,
  path,   // of a file, relative to the input file
  table,  // pairs of argument and value: a path of a CSV file, or a list
};

// What a quantity may depend on. One that does is also accepted as {expression, unit} or as {table}.
enum class Depends {
  on_nothing,
  on_place_and_time,  // x, y, z and t
  on_temperature,     // T
};

// Another key is given (or not), by its pattern, with `*` and `[]` standing for the same names and items as in the key that has
// the condition; with a word: it has this value.
struct Condition {
  std::string key;
  std::string word = {};
  bool absent = false;

  [[nodiscard]] std::string words() const;  // "with heat", "without packing", "with heat.integrator: implicit"
};

// How many numbers a quantity or integer key holds.
enum class Count {
  one,
  per_dimension,
  one_or_per_dimension,
  four,
};

struct Key {
  std::string path;  // pattern: materials.*.density, heat.boundaries[].body
  KeyType type = KeyType::section;
  std::string meaning;  // one sentence
  Quantity quantity = quantity::number;
  Range range = {};
  Count count = Count::one;
  Depends depends = Depends::on_nothing;  // of a table: its first column
  std::vector<std::string> words = {};    // of a word
  std::string fallback = {};              // YAML that stands for a missing key; empty: there is none
  std::string otherwise = {};             // what happens without the key, if there is no fallback, for the reference
  bool required = false;
  std::string choice = {};  // of the keys beside each other with one choice at most one is given; exactly one if required
  std::vector<Condition> only = {};  // the key has a use only if all hold
  bool implied = false;              // follows from the key above it, whose words in the reference say so
};

// A key among its neighbours. A key of type quantity may have keys below it: then either form is accepted. A map whose names
// are all among the keys below is of these, any other of `*`.
struct KeyNode {
  const Key* key = nullptr;
  std::vector<std::pair<std::string, std::unique_ptr<KeyNode>>> children;  // named `*` for user-chosen names, `[]` for items

  [[nodiscard]] const KeyNode* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const;
};

class KeyTable {
 public:
  // Every key's parent must stand before it. A quantity that depends on something gets the keys of its other forms.
  explicit KeyTable(std::vector<Key> keys);

  [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
  [[nodiscard]] const KeyNode& root() const { return root_; }
  [[nodiscard]] const Key* find(std::string_view path) const;  // by its pattern

 private:
  std::vector<Key> keys_;
  KeyNode root_;
};

// What the first column of a table holds: a temperature, or a time.
Quantity argument_of(const Key& key);

// materials.*.density -> materials, *, density; heat.boundaries[].body -> heat, boundaries, [], body
std::vector<std::string> split_path(std::string_view path);

// What a value must be: "must be positive, W/m/K", "must be one of whole, per_element". `dimension` numbers make a vector;
// 0 if it is not known.
std::string rule_words(const Key& key, int dimension);

}  // namespace scree
