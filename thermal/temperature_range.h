// The least and the largest of temperatures.
#pragma once

#include <limits>

#include "thermal/drive.h"

namespace scree::thermal {

struct TemperatureRange {
  double least = std::numeric_limits<double>::infinity();  // [K]
  double largest = -std::numeric_limits<double>::infinity();

  void include(const Eigen::VectorXd& temperatures);
  void include(const Drive& drive);  // temperatures held, and of surroundings
  void include(const TemperatureRange& other);
  // The nearest to these that are in it.
  [[nodiscard]] Eigen::VectorXd nearest(const Eigen::VectorXd& temperatures) const;
};

}  // namespace scree::thermal
