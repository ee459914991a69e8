// How errors grow where a specific heat falls. A node keeps the heat that it is wrong by, so one that comes out of a peak of
// latent heat is wrong by as many times more kelvin as its capacity has fallen. Step control goes by what errors may become.
#pragma once

#include <vector>

#include "thermal/heat_model.h"
#include "thermal/temperature_range.h"

namespace scree::thermal {

class ErrorGrowth {
 public:
  explicit ErrorGrowth(const HeatModel& model);

  // Whether any specific heat varies. Otherwise errors do not grow.
  [[nodiscard]] bool counts() const { return varies_; }

  // Temperatures stay in this range from now on, and in those given before. Whether that is more than was known.
  bool include(const TemperatureRange& range);

  // How many times as large the errors of nodes at these temperatures may become within that range; of no size if none grows.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& temperature) const;

  // The largest of what errors may become that grow so [K].
  [[nodiscard]] static double largest(const Eigen::VectorXd& error, const Eigen::VectorXd& growth);
  // By how much what a step adds to the errors of nodes makes that of any larger; no less than 0 [K].
  [[nodiscard]] static double largest_rise(const Eigen::VectorXd& error, const Eigen::VectorXd& added,
                                           const Eigen::VectorXd& growth);

 private:
  const HeatModel& model_;
  bool varies_ = false;        // any specific heat
  TemperatureRange range_;     // that `least_` is of
  std::vector<double> least_;  // specific heat of each material that varies there [J/kg/K]
};

// The temperatures that come from outside in the time until `until` [s], and those that loads alone lead to from these
// temperatures [K], of nodes that keep all heat and their capacities [J/K].
TemperatureRange given_until(Drives& drives, double until, const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity);

}  // namespace scree::thermal
