// What the parts of the key table share.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/base/key_row.h"

namespace scree {

using Keys = std::vector<Key>;

inline void append(Keys& keys, Keys more) {
  for (Key& key : more) keys.push_back(std::move(key));
}

// A default with its unit.
inline std::string with_unit(double value, std::string_view unit) {
  return fmt::format("{} {}", value, unit);
}

}  // namespace scree
