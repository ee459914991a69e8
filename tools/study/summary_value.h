// Figures of a summary by their dotted path.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace scree::study {

// heat.probes.inside.temperature; items of a list by their number from 0 or by their `name`: stages.heat.wall_seconds. Nothing
// there: null.
const nlohmann::json& value_at(const nlohmann::json& summary, const std::string& path);

// The paths of all figures, the items of lists by name or number.
std::vector<std::string> leaves(const nlohmann::json& summary);

}  // namespace scree::study
