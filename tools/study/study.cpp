#include "tools/study/study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/plain_number.h"

namespace scree::study {

Level Interval::at(double fraction, const SourceLocation& where) const {
  const double value = logarithmic ? low * std::pow(high / low, fraction) : low + fraction * (high - low);
  return level_of(whole ? std::round(value) : value, where);
}

Level Interval::drawn(double fraction, const SourceLocation& where) const {
  if (!whole || logarithmic) return at(fraction, where);
  return level_of(std::min(high, std::floor(low + fraction * (high - low + 1))), where);
}

Level Interval::level_of(double value, const SourceLocation& where) const {
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
