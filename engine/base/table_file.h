// A table of two columns in a CSV file: `time [h],temperature [degC]`, then a pair of numbers a line; `#` begins a comment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/linear_table.h"
#include "engine/base/value_rule.h"

namespace scree {

// A column that a table may begin with.
struct Argument {
  std::string name;
  Quantity quantity;
};

struct ReadTable {
  std::string argument;
  LinearTable values;  // SI
};

// The argument is one of `arguments`, named and with its unit in the head; the values obey `rule`. Throws InputError with
// everything that is wrong, each with its line and column in the file.
ReadTable read_table(const std::filesystem::path& file, const std::vector<Argument>& arguments, const ValueRule& rule);

}  // namespace scree
