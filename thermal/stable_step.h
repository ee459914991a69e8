// How long a step of explicit Euler may be.
#pragma once

#include "thermal/heat_balance.h"

namespace scree::thermal {

// Largest stable step of eq. (8) [s] and the node that moves most in the fastest mode, which sets it.
struct StableStep {
  double step = 0;
  NodeId node;
};

// 2 over a bound of the largest eigenvalue of A = C^-1 J of the free nodes, never below it. By Collatz and Wielandt (R. S.
// Varga, Matrix Iterative Analysis, 1962, section 2.1) no eigenvalue of A is larger than
//   max_i (|A| w)_i / w_i
// for whatever positive weights w. Equal ones give Gershgorin's bound; |A| w, |A|^2 w and so on bring it down to the largest
// eigenvalue of |A|, and are taken as long as that is worth their cost. Grids have a bound of their own (fastest_cell.h).
// Infinite, with no node, if nothing conducts.
class StableSteps {
 public:
  explicit StableSteps(const HeatModel& model);  // refers to it

  // At the model's initial temperatures.
  [[nodiscard]] const StableStep& at_start() const { return at_start_; }

  // At others [s], by one product with the weights of the start.
  [[nodiscard]] double at(const Linearised& state) const;

 private:
  const HeatModel* model_;
  Eigen::VectorXd weights_;  // kept where the properties change
  StableStep at_start_;
};

inline StableStep stable_step(const HeatModel& model) {
  return StableSteps(model).at_start();
}

}  // namespace scree::thermal
