// An input file after checking: every value of the right kind, in SI, with defaults filled in.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "engine/base/input.h"
#include "engine/base/key_table.h"

namespace scree {

struct CheckedEntry;

struct Checked {
  const Key* key = nullptr;
  std::string path;  // heat.boundaries[0].body
  SourceLocation where;
  bool given = true;               // written in the input, not filled in
  bool sound = false;              // the value follows the key's rule; else its numbers are 0 and its text is as written
  bool is_map = false;             // has entries
  std::string text;                // of a single value, as written
  std::vector<std::string> texts;  // of a list of numbers, as written; of a table argument and value in turn
  std::vector<double> numbers;     // in SI; a flag is 1 or 0
  std::vector<CheckedEntry> entries;
  std::vector<Checked> items;

  [[nodiscard]] const Checked* find(std::string_view name) const;
  [[nodiscard]] const Checked& at(std::string_view name) const;  // a value that is not sound if there is none

  [[nodiscard]] double number() const { return numbers.empty() ? 0 : numbers.front(); }
  [[nodiscard]] int integer() const;  // of a key whose range is within that of int
  [[nodiscard]] bool flag() const { return number() != 0; }
  [[nodiscard]] Eigen::Vector3d vector() const;  // z = 0 in 2-D

  // What is wrong with this value, for a list of problems.
  [[nodiscard]] Problem problem(std::string value, std::string rule, std::string suggestion = "") const;
};

struct CheckedEntry {
  std::string name;
  SourceLocation where;  // of the name
  Checked value;
};

// Holds `input` against the keys of the table and appends what is wrong to `problems`. `dimension` is the length of a vector.
Checked check_input(const InputValue& input, const KeyTable& table, int dimension, std::vector<Problem>& problems);

// Adds what was left out to a map of keys with fixed names, such as output, each in its place in the table.
void add_entries(Checked& map, const KeyTable& table, std::vector<CheckedEntry> more);

// The checked input as YAML with every default in it. Values stand as they were written; paths as `text` says.
std::string to_yaml(const Checked& checked);

}  // namespace scree
