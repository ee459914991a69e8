#include "thermal/least_conductivity.h"

#include <algorithm>
#include <limits>

#include "engine/base/check.h"

namespace scree::thermal {

namespace {

// A formula need not have a value at the temperature of a sky, which no block comes near.
double value_or_infinity(const Curve& curve, double temperature) {
  try {
    return curve(temperature);
  } catch (const InputError&) {
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

double least_conductivity(const Curve& conductivity, const TemperatureRange& range) {
  constexpr int looks = 64;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= (conductivity.constant() ? 0 : looks); ++i) {
    const double at = range.least + i * (range.largest - range.least) / looks;
    least = std::min(least, value_or_infinity(conductivity, at));
  }
  return least;
}

}  // namespace scree::thermal
