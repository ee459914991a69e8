// Single values against the rule of their key.
#pragma once

#include <vector>

#include "engine/base/checked_input.h"

namespace scree {

// Fills `checked`'s texts and numbers from a value that is not a map of keys.
void check_value(const InputValue& value, const Key& key, int dimension, Checked& checked, std::vector<Problem>& problems);

// Letters, digits, `_` and `-`, starting with a letter or `_`: a name that can stand in a path and in a column's head.
bool is_plain_name(std::string_view name);

}  // namespace scree
