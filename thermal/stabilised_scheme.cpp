// Stabilised explicit steps: RKL2, the Runge-Kutta-Legendre scheme of second order (Meyer, Balsara and Aslam, J. Comput. Phys.
// 257, 2014, eqs. 15 to 17). s products with K carry a step up to (s^2 + s - 2)/4 times as far as the stable one of eq. (8):
// where joints are no stiffer than blocks, that is less work than a factorisation.
//
// In increments D_j = Y_j - T0, for a drive that does not change and with L = C^-1 (K + B), B the convection:
//   D_j = mu D_j-1 + nu D_j-2 - mu~ h L D_j-1 + (mu~ + gamma~) h C^-1 F(T0),   D_1 = mu~_1 h C^-1 F(T0).
// The step is also h C^-1 F of the stages' weighted mean, whose difference to T0 obeys S_j = mu S_j-1 + nu S_j-2 + mu~ D_j-1:
// that is what the ledger is given.
//
// Local error. The polynomial's third coefficient is c = (N - 6)/(9 (N - 2)), N = s^2 + s, so a step leaves out (1/6 - c) h^3
// T''', while H = (T0 - T1) + h/2 (T0' + T1') is (1/4 - c) h^3 T''': the estimate is their quotient times -H. Over the negative
// axis it is never below a mode's true error, and far above it for modes that are faster than the step (Sommeijer, Shampine and
// Verwer, J. Comput. Appl. Math. 88, 1997, use the like for RKC). The error is carried by the scheme itself as a second column
// of each product.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/threads.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/heat_run.h"
#include "thermal/problems.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

// Temperatures and error side by side: a product reads the matrix once for both.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Pair = Eigen::Array2d;

constexpr int least_stages = 3;

int stages_for(double length, double stable) {
  const double ratio = length / stable;  // (s^2 + s - 2)/4
  const int stages = static_cast<int>(std::ceil(0.5 * (std::sqrt(9 + 16 * ratio) - 1)));
  return std::max(least_stages, stages | 1);  // an odd number damps the fastest modes
}

struct Coefficients {
  double mu, nu, product, start;  // of D_j-1, D_j-2, -h L D_j-1 and h C^-1 F(T0)
};

// Of stage j >= 2 of s.
Coefficients coefficients(int j, int stages) {
  const auto b = [](int i) { return i < 2 ? 1.0 / 3 : (i * i + i - 2.0) / (2.0 * i * (i + 1)); };
  const double w1 = 4.0 / (stages * stages + stages - 2.0);
  const double mu = (2.0 * j - 1) / j * b(j) / b(j - 1);
  const double nu = -(j - 1.0) / j * b(j) / b(j - 2);
  const double product = mu * w1;
  return {mu, nu, product, product - (1 - b(j - 1)) * product};
}

double first_coefficient(int stages) {
  return 4.0 / (3 * (stages * stages + stages - 2.0));
}

// What takes h^3 T''' of H to that of the step.
double estimate_of(int stages) {
  const double n = stages * stages + stages;
  const double third = (n - 6) / (9 * (n - 2));
  return (third - 1.0 / 6) / (0.25 - third);
}

class StabilisedScheme : public TimeScheme {
 public:
  explicit StabilisedScheme(const HeatModel& model)
      : model_(model),
        inverse_(model.capacity.cwiseInverse()),
        drives_(model),
        balance_(model, Sums::plain),
        linear_(balance_.linearised(model.initial, drives_.at(0))),
        stable_(stable_step(model).step) {
    for (const NodeId node : model.fixed_nodes) inverse_[node.value()] = 0;  // as good as an infinite capacity
  }

  Step step(const Instant& from, double length) override {
    const int stages = std::isinf(stable_) ? least_stages : stages_for(length, stable_);
    const Columns start = starting_rates(from, length);
    Columns older = Columns::Zero(start.rows(), 2);
    Columns newer = first_coefficient(stages) * start;
    Eigen::VectorXd older_mean = Eigen::VectorXd::Zero(start.rows());
    Eigen::VectorXd mean = older_mean;
    for (int j = 2; j <= stages; ++j) {
      const Coefficients with = coefficients(j, stages);
      older_mean = with.mu * mean + with.nu * older_mean + with.product * newer.col(0);
      advance(with, length, start, newer, older);
      older.swap(newer);
      older_mean.swap(mean);
    }
    Step result;
    result.change = newer.col(0);
    const Columns last = rates(newer, length);  // h L D
    const Eigen::VectorXd h3 = -result.change + start.col(0) - 0.5 * last.col(0);
    const Eigen::VectorXd local = estimate_of(stages) * h3;
    result.error = from.error + newer.col(1) + local;
    result.local_error = local.lpNorm<Eigen::Infinity>();
    result.stages = {{1, from.time + length, from.temperature + mean}};
    return result;
  }

  // The local error of a short step is h^3 T'''/18 at most.
  double first_step(const Instant& from, double allowed) override {
    Columns derivative = starting_rates({from.time, from.temperature, Eigen::VectorXd::Zero(inverse_.size())}, 1);
    for (int order = 2; order <= 3; ++order) derivative = rates(derivative, 1);
    const double largest = derivative.col(0).lpNorm<Eigen::Infinity>();
    return largest > 0 ? std::cbrt(18 * allowed / largest) : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] double safety() const override { return 1; }
  [[nodiscard]] Sums sums() const override { return Sums::plain; }
  [[nodiscard]] std::string name() const override {
    return fmt::format("RKL2 (stabilised explicit, second order) with steps from the tolerance; stable Euler step {:.3g} s",
                       stable_);
  }

 private:
  // h C^-1 F of the temperatures, and of the error, which nothing drives.
  Columns starting_rates(const Instant& from, double length) {
    Columns start(inverse_.size(), 2);
    start.col(0) = length * inverse_.cwiseProduct(balance_.heating(from.temperature, drives_.at(from.time)));
    start.col(1) = -length * inverse_.cwiseProduct(balance_.lost(from.error, linear_));
    return start;
  }

  // (K + B) x of one row, as flows between pairs of nodes.
  [[nodiscard]] Pair leaving(const Columns& x, Eigen::Index row) const {
    const Pair here = x.row(row).transpose();
    Pair sum = linear_.loss[row] * here;
    const int* outer = model_.conductance.outerIndexPtr();
    const int* inner = model_.conductance.innerIndexPtr();
    const double* values = model_.conductance.valuePtr();
    for (int k = outer[row]; k < outer[row + 1]; ++k) {
      sum += values[k] * (x.row(inner[k]).transpose().array() - here);
    }
    return sum;
  }

  // h L x.
  [[nodiscard]] Columns rates(const Columns& x, double length) const {
    Columns result(x.rows(), 2);
#pragma omp parallel for schedule(static) if (x.rows() >= rows_worth_sharing)
    for (Eigen::Index row = 0; row < x.rows(); ++row) {
      result.row(row) = (length * inverse_[row]) * leaving(x, row).matrix().transpose();
    }
    return result;
  }

  // D_j in the place of D_j-2.
  void advance(const Coefficients& with, double length, const Columns& start, const Columns& newer, Columns& older) const {
#pragma omp parallel for schedule(static) if (newer.rows() >= rows_worth_sharing)
    for (Eigen::Index row = 0; row < newer.rows(); ++row) {
      const Pair flow = leaving(newer, row);
      const Pair next = with.mu * newer.row(row).transpose().array() + with.nu * older.row(row).transpose().array() -
                        (with.product * length * inverse_[row]) * flow + with.start * start.row(row).transpose().array();
      older.row(row) = next.matrix().transpose();
    }
  }

  const HeatModel& model_;
  Eigen::VectorXd inverse_;  // of the capacity, 0 for a fixed node [K/J]
  Drives drives_;
  HeatBalance balance_;
  Linearised linear_;  // the same at all times
  double stable_;      // of eq. (8) [s]
};

}  // namespace

std::unique_ptr<TimeScheme> make_stabilised_scheme(const HeatModel& model) {
  if (!can_be_stabilised(model)) {
    throw InputError(problem("heat.integrator", "stabilised_explicit",
                             "must not be asked to do radiation, or properties, coefficients or conditions that change in time",
                             "Use the implicit integrator"));
  }
  return std::make_unique<StabilisedScheme>(model);
}

bool can_be_stabilised(const HeatModel& model) {
  return has_constant_properties(model) && !varies_in_time(model);
}

double stabilised_products(const HeatModel& model, const TimeOptions& options) {
  const double stable = stable_step(model).step;
  if (std::isinf(stable)) return 0;
  // After a sudden start steps grow with time, each some fifth of what has passed, up to the output interval.
  const double every = options.output_every > 0 ? std::min(options.output_every, options.until) : options.until;
  const double grown = 1 / (1 - std::exp(-0.1));
  const double steady = options.until / every;
  return 2 * std::sqrt(0.2 * every / stable) * grown + 2 * std::sqrt(every / stable) * std::max(0.0, steady - 1);
}

}  // namespace scree::thermal
