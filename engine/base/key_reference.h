// A key table for people and for editors.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/key_table.h"

namespace scree {

// The keys whose path begins with `prefix`, as aligned text, one block per section. Empty if there is none.
std::string key_reference(const KeyTable& table, std::string_view prefix = "");

// A JSON schema (draft 2020-12) of the input file, for completion and checks in editors.
std::string key_schema(const KeyTable& table, const std::string& title);

}  // namespace scree
