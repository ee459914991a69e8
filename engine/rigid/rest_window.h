// How long a pile must be at rest.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/rigid/settle.h"

namespace scree::rigid {

// The window in which a pile must be at rest [s]: that of the options, or thrice the time in which gravity moves by as much as
// is allowed whatever nothing holds, where that is longer. In weak gravity nothing gets far in less.
inline double rest_window(const SettleOptions& options, double mean_edge) {
  constexpr double times = 3;
  const double gravity = options.gravity.norm();
  if (gravity == 0) return options.rest_window;
  return std::max(options.rest_window, times * std::sqrt(2 * options.rest_displacement * mean_edge / gravity));
}

}  // namespace scree::rigid
