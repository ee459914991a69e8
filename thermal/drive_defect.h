// What a step misses of loads and surroundings that jump within it.
//
// A step sees what drives it at its stages; its estimate of the error sees it at its start, too, and takes it for a parabola in
// between (sdirk2.h). With f what comes into a node [W] and w the weights of that parabola's quadrature, the estimate lacks
//   (h sum_i w_i f(t_i) - integral of f over the step)/C,
// which is added to it: exact for a block that nothing else acts on, and too large for nodes that pass on their heat faster
// than the step.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Of each row, for a step from `begin` [s]; `temperature` and `capacity` [J/K] are those at its start; zero at fixed nodes [K].
Eigen::VectorXd drive_defect(const HeatModel& model, double begin, double length, const Eigen::VectorXd& temperature,
                             const Eigen::VectorXd& capacity);

}  // namespace scree::thermal
