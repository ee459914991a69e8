// Errors about the heat part of a scene.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/check.h"

namespace scree::thermal {

// Member by member: GCC 12 takes the clean-up of a braced Problem for a use of uninitialised strings.
inline Problem problem(std::string_view key, std::string_view value, std::string_view rule, std::string_view suggestion = {}) {
  Problem result;
  result.key = key;
  result.value = value;
  result.rule = rule;
  result.suggestion = suggestion;
  return result;
}

}  // namespace scree::thermal
