// The least that a property may be between two temperatures.
#pragma once

#include "engine/base/curve.h"
#include "thermal/temperature_range.h"

namespace scree::thermal {

// At `looks` + 1 temperatures, evenly from the least to the largest; infinite if a formula has no value at any of them. It need
// not have one where no block comes, as at the temperature of a sky.
double least_value(const Curve& curve, const TemperatureRange& range, int looks = 64);

}  // namespace scree::thermal
