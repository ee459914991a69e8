// When something first is what one waits for.
#pragma once

#include <optional>
#include <vector>

namespace scree::study {

// The first time at which a quantity has a value, linear between its samples; nothing if it never has.
std::optional<double> first_time_at(const std::vector<double>& times, const std::vector<double>& values, double value);

}  // namespace scree::study
