// The paper's scheme, eqs. (7) and (8): T' = T + dt C^-1 (Q - K T), forward Euler. Stable up to dt = 2/lambda_max of C^-1 K.
// The companion for the error estimate is the second-order Taylor series, stable over the same interval; there the estimate is
// never below the true error of a step, and at most 1.8 times it.
//
// Properties and coefficients must not change, so that the stable step holds for the whole run; loads, temperatures of
// boundaries and of surroundings may.
#include <cmath>
#include <limits>

#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/problems.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

class ExplicitScheme : public TimeScheme {
 public:
  explicit ExplicitScheme(const HeatModel& model)
      : model_(model),
        inverse_(inverse_capacity(model, model.capacity)),
        drives_(model),
        balance_(model),
        linear_(balance_.linearised(model.initial, drives_.at(0))) {}

  Step step(const Instant& from, double length) override {
    const Eigen::VectorXd heating = balance_.heating(from.temperature, drives_.at(from.time));
    const Eigen::VectorXd slope = inverse_.cwiseProduct(heating);
    const Eigen::VectorXd error_slope = -inverse_.cwiseProduct(balance_.lost(from.error, linear_));
    Step result;
    result.change = held(model_, from.temperature + length * slope, drives_.at(from.time + length)) - from.temperature;
    // h^2/2 of the companion's second derivative is what Euler leaves out: here that of what the temperatures change. What the
    // drive changes is looked at for itself, as Euler sees it at the step's start only (drive_quadrature).
    const auto held_nodes = static_cast<Eigen::Index>(model_.fixed_nodes.size());
    const Eigen::VectorXd moved = held(model_, result.change - length * error_slope, Eigen::VectorXd::Zero(held_nodes));
    result.local = 0.5 * length * inverse_.cwiseProduct(balance_.lost(moved, linear_));
    result.error = from.error + length * error_slope + result.local;
    result.stages = {{1, from.time, from.temperature}};
    return result;
  }

  // Steps are bounded by stability and given by the user, not chosen from an error.
  double first_step(const Instant&, double) override { return std::numeric_limits<double>::infinity(); }

  [[nodiscard]] std::vector<Look> drive_quadrature(double) const override { return {{0, 1}}; }
  [[nodiscard]] double safety() const override { return 1; }
  [[nodiscard]] double cost_exponent() const override { return 1; }
  [[nodiscard]] std::string name() const override { return "explicit Euler, eq. (8), fixed steps"; }

 private:
  const HeatModel& model_;
  Eigen::VectorXd inverse_;  // of the capacity, 0 for a fixed node [K/J]
  Drives drives_;
  HeatBalance balance_;
  Linearised linear_;  // the same at all times
};

}  // namespace

std::unique_ptr<TimeScheme> make_explicit_scheme(const HeatModel& model) {
  if (!has_constant_properties(model)) {
    throw InputError(problem("heat.integrator", "explicit_euler",
                             "must not be asked to do radiation, or properties or coefficients that change",
                             "Use the implicit integrator"));
  }
  return std::make_unique<ExplicitScheme>(model);
}

}  // namespace scree::thermal
