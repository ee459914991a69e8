// The paper's scheme, eqs. (7) and (8): T' = T + dt C^-1 (Q - K T), forward Euler. Stable up to dt = 2/lambda_max of C^-1 K.
// The companion for the error estimate is the second-order Taylor series, stable over the same interval; there the estimate is
// never below the true error of a step, and at most 1.8 times it.
#include <cmath>
#include <limits>

#include "thermal/flow_network.h"
#include "thermal/heat_run.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

class ExplicitScheme : public TimeScheme {
 public:
  explicit ExplicitScheme(const HeatModel& model)
      : model_(model), inverse_(model.capacity.cwiseInverse()), flows_(model.conductance) {
    for (const NodeId node : model.fixed_nodes) inverse_[node.value()] = 0;  // as good as an infinite capacity
  }

  Step step(const Eigen::VectorXd& temperature, const Eigen::VectorXd& error, double length) override {
    const Eigen::VectorXd heating = model_.load - flows_.leaving(temperature);
    const Eigen::VectorXd slope = inverse_.cwiseProduct(heating);
    const Eigen::VectorXd error_slope = -inverse_.cwiseProduct(flows_.leaving(error));
    // dt^2/2 of the companion's second derivative is what Euler leaves out.
    const Eigen::VectorXd second = -inverse_.cwiseProduct(flows_.leaving(slope - error_slope));
    const Eigen::VectorXd local = -0.5 * length * length * second;
    return {length * slope, error + length * error_slope + local, -heating, local.lpNorm<Eigen::Infinity>()};
  }

  // Steps are bounded by stability and given by the user, not chosen from an error.
  double first_step(const Eigen::VectorXd&, double) override { return std::numeric_limits<double>::infinity(); }

  [[nodiscard]] double safety() const override { return 1; }
  [[nodiscard]] std::string name() const override { return "explicit Euler, eq. (8), fixed steps"; }

 private:
  const HeatModel& model_;
  Eigen::VectorXd inverse_;  // of the capacity, 0 for a fixed node [K/J]
  FlowNetwork flows_;
};

}  // namespace

std::unique_ptr<TimeScheme> make_explicit_scheme(const HeatModel& model) {
  return std::make_unique<ExplicitScheme>(model);
}

StableStep stable_step(const HeatModel& model) {
  std::vector<char> fixed(static_cast<std::size_t>(model.capacity.size()), 0);
  for (const NodeId node : model.fixed_nodes) fixed[node.index()] = 1;
  StableStep limit{std::numeric_limits<double>::infinity(), NodeId{}};
  for (std::size_t node = 0; node < fixed.size(); ++node) {
    if (fixed[node] != 0) continue;
    double row = 0;  // the matrix is symmetric: its column will do
    const auto column = static_cast<Eigen::Index>(node);
    for (SparseMatrix::InnerIterator entry(model.conductance, column); entry; ++entry) {
      if (fixed[entry.row()] == 0) row += std::abs(entry.value());
    }
    const double step = 2 * model.capacity[column] / row;
    if (step < limit.step) limit = {step, NodeId{node}};
  }
  return limit;
}

}  // namespace scree::thermal
