// Values of a summary.json, as a page shows them.
#pragma once

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/report/page.h"

namespace scree::report {

using Json = nlohmann::ordered_json;

// Not a number (JSON's null) if it is not there.
inline double number(const Json& json, const std::string& key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : std::nan("");
}

inline std::string text(const Json& json, const std::string& key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

// The number, or these words if it has none.
inline std::string value_or(const Json& json, const std::string& key, const std::string& words) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? figure(found->get<double>()) : words;
}

}  // namespace scree::report
