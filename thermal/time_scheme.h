// What one step of a time scheme does to C dT/dt = Q - K T.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "thermal/heat_model.h"

namespace scree::thermal {

struct Step {
  Eigen::VectorXd change;  // of the temperature, zero at fixed nodes [K]
  Eigen::VectorXd error;   // global error after the step, per node [K]
  // Heat that fixed nodes need to stay fixed, K T - Q in the mean over the step with the scheme's own weights; only its fixed
  // rows mean anything [W].
  Eigen::VectorXd supply;
  double local_error = 0;  // largest entry of this step's own contribution to the error [K]
};

// A linear one-step scheme with its estimate of the global error. Beside the temperatures T a scheme follows, in exact
// arithmetic, a second solution V of one order more; error = T - V. Kept as the difference, that is: the error is carried by
// the scheme's own operator, and each step adds the difference between the two schemes applied to V.
class TimeScheme {
 public:
  virtual ~TimeScheme() = default;

  virtual Step step(const Eigen::VectorXd& temperature, const Eigen::VectorXd& error, double length) = 0;

  // A step whose local error is about `allowed` [K] from a state whose past is unknown [s]; infinite if nothing changes.
  virtual double first_step(const Eigen::VectorXd& temperature, double allowed) = 0;

  // What the estimated error is multiplied with so as to bound the true one.
  [[nodiscard]] virtual double safety() const = 0;
  [[nodiscard]] virtual std::int64_t factorisations() const { return 0; }
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  TimeScheme() = default;
  TimeScheme(const TimeScheme&) = default;
  TimeScheme& operator=(const TimeScheme&) = default;
};

std::unique_ptr<TimeScheme> make_implicit_scheme(const HeatModel& model);
std::unique_ptr<TimeScheme> make_explicit_scheme(const HeatModel& model);

}  // namespace scree::thermal
