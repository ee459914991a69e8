// What a run's temperatures reached.
#include <algorithm>

#include "thermal/heat_run.h"

namespace scree::thermal {

void TemperatureRange::include(const Eigen::VectorXd& temperatures) {
  if (temperatures.size() == 0) return;
  least = std::min(least, temperatures.minCoeff());
  largest = std::max(largest, temperatures.maxCoeff());
}

void TemperatureRange::include(const Drive& drive) {
  include(drive.fixed);
  for (const ExchangeRates& rates : drive.exchanges) include(rates.surroundings);
}

void TemperatureRange::include(const TemperatureRange& other) {
  least = std::min(least, other.least);
  largest = std::max(largest, other.largest);
}

Eigen::VectorXd TemperatureRange::nearest(const Eigen::VectorXd& temperatures) const {
  return temperatures.cwiseMax(least).cwiseMin(largest);
}

std::optional<double> overshoot(const HeatModel& model, const HeatState& state) {
  if (!model.loads.empty()) return std::nullopt;
  const double above = state.reached.largest - state.given.largest;
  return std::max({0.0, above, state.given.least - state.reached.least});
}

}  // namespace scree::thermal
