// A YAML file as plain data, every value with its place in the file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/check.h"

namespace scree {

struct InputEntry;

struct InputValue {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  SourceLocation where;
  std::string text = {};               // of a scalar, as written
  std::vector<InputValue> items = {};  // of a list
  std::vector<InputEntry> entries;     // of a map, in the order of the file

  // The value under a name in a map; nothing if there is none.
  [[nodiscard]] const InputValue* find(std::string_view name) const;
};

struct InputEntry {
  std::string name;
  SourceLocation where;
  InputValue value;
};

// Anchors and aliases work; `<<` is a name like any other. Throws InputError for a file that cannot be read or is not YAML, and
// for a name given twice in a map.
InputValue read_yaml(const std::filesystem::path& file);

// The same for a text; `name` stands for the file in messages.
InputValue parse_yaml(const std::string& text, const std::string& name);

// Sets `key.path=value`: the value is YAML, items of a list are counted from 0 (`heat.boundaries.0.temperature` or
// `heat.boundaries[0].temperature`), missing maps on the way are made, and `null` takes the key away. Throws InputError.
void apply_override(InputValue& root, const std::string& assignment);

// "a map", "a list", "empty", or the text (shortened): how a message quotes the value.
std::string describe(const InputValue& value);

}  // namespace scree
