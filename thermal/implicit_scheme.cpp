// The implicit scheme: SDIRK of two stages, second order, L-stable (Alexander 1977; Hairer & Wanner 1996, section IV.6). For
// our constant coefficients TR-BDF2 (Bank et al. 1985) with the same matrix is the same map.
//
// With gamma = 1 - 1/sqrt 2, z = -dt lambda and S = 1/(1 - gamma z), one step multiplies a mode by
//   R(z) = (1 + (1 - 2 gamma) z) S^2,
// so both stages solve with the one matrix C + gamma dt K. Written in increments, which keeps rounding small near a steady
// state,
//   (C + gamma dt K) d1 = gamma dt (Q - K T),   (C + gamma dt K) d2 = C d1,   T' = T + d1 + (1 + sqrt 2) d2.
// The flows act with the weights 1 - gamma and gamma of the two stages, which is at the temperature T + d1 + (1 - gamma) d2:
// with it the ledger closes exactly.
//
// The companion V uses two further solves, d3 and d4 alike, and R^(z) = R(z) - kappa S (S - 1)^3, kappa the constant that makes
// it third order: kappa = (3 gamma^2 - 2 gamma^3 - 1/6)/gamma^3. It is the only such polynomial in S of degree 4 that is
// L-stable too, so the estimate stays right for modes that are much faster than the step: over the whole negative axis (R -
// R^)/(R - exp) lies between 0.73 and 1.14.
#include <cmath>
#include <limits>

#include "thermal/flow_network.h"
#include "thermal/free_nodes.h"
#include "thermal/shifted_solver.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

const double root2 = std::sqrt(2.0);
const double gamma = 1 - 1 / root2;
const double third_order = 3 * gamma * gamma - 2 * gamma * gamma * gamma - 1.0 / 6;  // R - exp = third_order z^3 + ...
const double kappa = third_order / (gamma * gamma * gamma);

class ImplicitScheme : public TimeScheme {
 public:
  explicit ImplicitScheme(const HeatModel& model)
      : model_(model),
        free_(model),
        capacity_(free_.gather(model.capacity)),
        solver_(capacity_, free_.lower_block(model.conductance)),
        flows_(model.conductance) {}

  Step step(const Eigen::VectorXd& temperature, const Eigen::VectorXd& error, double length) override {
    solver_.prepare(gamma * length);
    Eigen::MatrixXd rate(temperature.size(), 2);  // of T, and of the error, which has no load
    rate.col(0) = heating(temperature);
    rate.col(1) = -flows_.leaving(error);
    const Eigen::MatrixXd d1 = solver_.solve(gamma * length * free_.gather(rate));
    const Eigen::MatrixXd d2 = solver_.solve(capacity_.asDiagonal() * d1);
    const Eigen::VectorXd companion2 = d2.col(0) - d2.col(1);  // V = T - error
    const Eigen::VectorXd companion3 = solver_.solve(capacity_.asDiagonal() * companion2);
    const Eigen::VectorXd companion4 = solver_.solve(capacity_.asDiagonal() * companion3);
    // S (S - 1)^3 = (S - 1)^2 of d2.
    const Eigen::VectorXd local = kappa * (companion4 - 2 * companion3 + companion2);

    Step result;
    const Eigen::MatrixXd change = free_.scatter(d1 + (1 + root2) * d2);
    result.change = change.col(0);
    result.error = error + change.col(1) + free_.scatter(local);
    result.supply = -heating(temperature + free_.scatter(d1.col(0) + (1 - gamma) * d2.col(0)));
    result.local_error = local.lpNorm<Eigen::Infinity>();
    return result;
  }

  // The local error of a short step is third_order dt^3 T'''.
  double first_step(const Eigen::VectorXd& temperature, double allowed) override {
    Eigen::VectorXd derivative = free_.gather(heating(temperature)).cwiseQuotient(capacity_);
    for (int order = 2; order <= 3; ++order) {
      const Eigen::VectorXd heat = flows_.leaving(free_.scatter(derivative));
      derivative = -free_.gather(heat).cwiseQuotient(capacity_);
    }
    const double largest = derivative.lpNorm<Eigen::Infinity>();
    return largest > 0 ? std::cbrt(allowed / (third_order * largest)) : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] double safety() const override { return 1 / 0.73; }
  [[nodiscard]] std::int64_t factorisations() const override { return solver_.factorisations(); }
  [[nodiscard]] std::string name() const override {
    return "SDIRK2 (L-stable, second order) with steps from the tolerance; CHOLMOD supernodal Cholesky";
  }

 private:
  // Q - K T [W].
  [[nodiscard]] Eigen::VectorXd heating(const Eigen::VectorXd& temperature) const {
    return model_.load - flows_.leaving(temperature);
  }

  const HeatModel& model_;
  FreeNodes free_;
  Eigen::VectorXd capacity_;  // of the free nodes [J/K]
  ShiftedSolver solver_;
  FlowNetwork flows_;
};

}  // namespace

std::unique_ptr<TimeScheme> make_implicit_scheme(const HeatModel& model) {
  return std::make_unique<ImplicitScheme>(model);
}

}  // namespace scree::thermal
