#include "tools/study/study.h"

#include <cmath>

#include <fmt/format.h>

namespace scree::study {

Level Interval::at(double fraction, const SourceLocation& where) const {
  double value = logarithmic ? low * std::pow(high / low, fraction) : low + fraction * (high - low);
  // The ends as they were written, whatever the rounding.
  if (fraction <= 0) value = low;
  if (fraction >= 1) value = high;
  if (whole) value = std::round(value);
  return {fmt::format("{:.17g}{}{}", value, unit.empty() ? "" : " ", unit), value, where};
}

std::vector<std::string> Study::varied() const {
  std::vector<std::string> names;
  for (const Factor& factor : factors) names.push_back(factor.name());
  if (ensemble) names.push_back(ensemble->name());
  return names;
}

}  // namespace scree::study
