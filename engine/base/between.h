// How many of ascending values lie between two.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace scree {

// Without the two themselves.
inline std::size_t count_between(const std::vector<double>& ascending, double low, double high) {
  const auto first = std::upper_bound(ascending.begin(), ascending.end(), low);
  const auto last = std::lower_bound(first, ascending.end(), high);
  return static_cast<std::size_t>(last - first);
}

}  // namespace scree
