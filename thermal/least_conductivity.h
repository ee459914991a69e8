// How badly a material may conduct between two temperatures.
#pragma once

#include "engine/base/curve.h"
#include "thermal/temperature_range.h"

namespace scree::thermal {

// The least k in the range, at 65 temperatures [W/m/K]; infinite if it has no value at any of them.
double least_conductivity(const Curve& conductivity, const TemperatureRange& range);

}  // namespace scree::thermal
