#include "engine/base/range.h"

#include <cmath>

#include <fmt/format.h>

namespace scree {

bool Range::holds(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::string Range::words() const {
  const bool below = std::isfinite(high);
  if (!std::isfinite(low)) return below ? fmt::format("{} {}", high_open ? "below" : "at most", high) : "";
  if (!below && low == 0) return low_open ? "positive" : "not negative";
  std::string text = fmt::format("{} {}", low_open ? "above" : "at least", low);
  if (below) text += fmt::format(" and {} {}", high_open ? "below" : "at most", high);
  return text;
}

}  // namespace scree
