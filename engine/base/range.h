// What numbers are accepted.
#pragma once

#include <limits>
#include <string>

namespace scree {

// Of a list or a map of names: how many entries.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   // low itself is refused
  bool high_open = false;  // high itself is refused

  [[nodiscard]] bool holds(double value) const;
  [[nodiscard]] std::string words() const;  // "positive", "at least 0 and below 1"; empty if everything is accepted
};
inline constexpr Range positive{.low = 0, .low_open = true};
inline constexpr Range not_negative{.low = 0};
inline constexpr Range at_least_one{.low = 1};

}  // namespace scree
