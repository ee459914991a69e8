// Heat exchanged with surroundings at a node: the home of convection and radiation.
//
// Into a node with the share A of the surface [m2], at its temperature T and the surroundings' T_s [K]:
//   convection (Newton):        h A (T_s - T),                    h [W/m2/K]
//   radiation (Stefan, Boltzmann): sigma epsilon A (T_s^4 - T^4),  sigma below, epsilon the emissivity [-]; to surroundings far
//                               larger than the body, so that nothing comes back.
// A face gives each of its corners the same share, as it does with a flux: exact for a linear temperature in total, second
// order in space, and without the overshoot that the consistent form makes on coarse meshes. T^4 is continued as T |T|^3 below
// 0 K, so that an iteration that strays there finds its way back.
#pragma once

#include <cmath>

#include "thermal/drive.h"

namespace scree::thermal {

constexpr double stefan_boltzmann = 5.670374419e-8;  // CODATA 2018, exact to its digits [W/m2/K4]

// Of the exchange's node `i`, at temperature `t` [W].
inline double exchanged_heat(Exchange::Law law, const ExchangeRates& rates, Eigen::Index i, double t) {
  const double s = rates.surroundings[i];
  const double f = rates.factor[i];
  if (law == Exchange::Law::convection) return f * (s - t);
  return t >= 0 ? f * (s - t) * (s + t) * (s * s + t * t) : f * (s * s * s * s + t * t * t * t);
}

// How much less heat comes in per kelvin that the node is warmer [W/K].
inline double exchange_slope(Exchange::Law law, const ExchangeRates& rates, Eigen::Index i, double t) {
  return law == Exchange::Law::convection ? rates.factor[i] : 4 * rates.factor[i] * std::abs(t * t * t);
}

}  // namespace scree::thermal
