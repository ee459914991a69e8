#include "tools/study/study.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/plain_number.h"

namespace scree::study {

Level Interval::at(double fraction, const SourceLocation& where) const {
  double value = logarithmic ? low * std::pow(high / low, fraction) : low + fraction * (high - low);
  if (whole) value = std::round(value);
  // As a person would write it: 10, where the power of a logarithm ends in 9.999999999999998.
  const std::string text = fmt::format("{:.12g}", value);
  return {fmt::format("{}{}{}", text, unit.empty() ? "" : " ", unit), plain_number(text).value(), where};
}

std::vector<std::string> Study::varied() const {
  std::vector<std::string> names;
  for (const Factor& factor : factors) names.push_back(factor.name());
  if (ensemble) names.push_back(ensemble->name());
  return names;
}

}  // namespace scree::study
