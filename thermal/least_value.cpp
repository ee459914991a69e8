#include "thermal/least_value.h"

#include <algorithm>
#include <limits>

#include "engine/base/check.h"

namespace scree::thermal {

namespace {

double value_or_infinity(const Curve& curve, double temperature) {
  try {
    return curve(temperature);
  } catch (const InputError&) {
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

double least_value(const Curve& curve, const TemperatureRange& range, int looks) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= (curve.constant() ? 0 : looks); ++i) {
    const double at = range.least + (range.largest - range.least) * i / looks;
    least = std::min(least, value_or_infinity(curve, at));
  }
  return least;
}

}  // namespace scree::thermal
