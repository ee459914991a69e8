// What a step misses of loads and surroundings that jump within it.
//
// A step sees what drives it at some times only, and its estimate of the error takes it for a parabola between them. With f
// what comes into a node [W] and w the weights of that parabola's quadrature (TimeScheme::drive_quadrature), the estimate lacks
//   (h sum_i w_i f(t_i) - integral of f over the step)/C,
// which is added to it: exact for a block that nothing else acts on, and too large for nodes that pass on their heat faster
// than the step.
#pragma once

#include <vector>

#include "thermal/heat_model.h"

namespace scree::thermal {

// Of a quadrature over a step: when it looks, as a part of the step, and with what weight.
struct Look {
  double part;
  double weight;
};

// Of each row, for a step from `begin` [s]; `temperature` and `capacity` [J/K] are those at its start; zero at fixed nodes [K].
Eigen::VectorXd drive_defect(const HeatModel& model, const std::vector<Look>& quadrature, double begin, double length,
                             const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity);

}  // namespace scree::thermal
