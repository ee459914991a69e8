// What a step misses of loads, surroundings and temperatures that jump or swing within it.
//
// A step sees what drives it at some times only, and its estimate of the error takes it for a parabola between them; that of
// Euler's steps takes it for what it is at the start. With f what comes into a node [W] and w the weights of the quadrature
// that this is (TimeScheme::drive_quadrature), the estimate lacks
//   (h sum_i w_i f(t_i) - integral of f over the step)/C,
// which is added to it: exact for a block that nothing else acts on, and too large for nodes that pass on their heat faster
// than the step. A held temperature counts in the mean for
//   sum_i w_i f(t_i) - integral of f over the step/h
// more than it is: an error that its node has throughout the step, so that the scheme itself carries it to the others.
#pragma once

#include <vector>

#include "thermal/heat_model.h"

namespace scree::thermal {

// Of a quadrature over a step: when it looks, as a part of the step, and with what weight.
struct Look {
  double part;
  double weight;
};

struct DriveDefect {
  Eigen::VectorXd free;  // of each row; zero at fixed nodes [K]
  Eigen::VectorXd held;  // of the fixed nodes, in their order [K]
};

// A step and what is known of it.
struct LookedAt {
  double begin;   // [s]
  double length;  // [s]
  // Nothing is known to bend or jump within it. Then there are three looks for the integral of a formula of place, those of
  // Gauss's rule, which is exact to fifth order, else 16. And what misses less than `negligible` [K] at 16 places of a formula
  // of place is not asked at its others.
  bool smooth;
  double negligible;
};

// `temperature` and `capacity` [J/K] are those at the step's start.
DriveDefect drive_defect(const HeatModel& model, const std::vector<Look>& quadrature, const LookedAt& step,
                         const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity);

}  // namespace scree::thermal
