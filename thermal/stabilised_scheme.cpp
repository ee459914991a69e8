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
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "engine/base/huge_pages.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/problems.h"
#include "thermal/stable_step.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

// Temperatures and error side by side: a product reads the matrix once for both.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

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

// S at the nodes that the ledger reads, which are ascending.
class WatchedMean {
 public:
  explicit WatchedMean(const std::vector<NodeId>& nodes) : nodes_(nodes) {
    for (std::vector<double>& mean : means_) mean.assign(nodes.size(), 0.0);
  }

  // Stage j of these rows, in the place of j - 2, from D of the one before.
  void advance(int j, const Coefficients& with, const Columns& increment, int first, int rows) {
    const std::vector<double>& newer = means_[(j - 1) % 2];
    std::vector<double>& older = means_[j % 2];
    const auto begin = std::lower_bound(nodes_.begin(), nodes_.end(), NodeId(static_cast<std::size_t>(first)));
    for (auto node = begin; node != nodes_.end() && node->value() < first + rows; ++node) {
      const auto i = static_cast<std::size_t>(node - nodes_.begin());
      older[i] = with.mu * newer[i] + with.nu * older[i] + with.product * increment(node->value(), 0);
    }
  }

  // The last of so many stages.
  [[nodiscard]] Eigen::VectorXd added_to(Eigen::VectorXd temperature, int stages) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) temperature[nodes_[i].value()] += means_[stages % 2][i];
    return temperature;
  }

 private:
  const std::vector<NodeId>& nodes_;
  std::array<std::vector<double>, 2> means_;
};

class StabilisedScheme : public TimeScheme {
 public:
  StabilisedScheme(const HeatModel& model, double stable)
      : inverse_(model.capacity.cwiseInverse()),
        drives_(model),
        balance_(model, Sums::plain),
        linear_(balance_.linearised(model.initial, drives_.at(0))),
        stable_(stable),
        sharing_(model.shared_capacity ? &*model.shared_capacity : nullptr, Sums::plain),
        watched_(ledger_nodes(model)) {
    for (const NodeId node : model.fixed_nodes) inverse_[node.value()] = 0;  // as good as an infinite capacity
    for (Columns* columns : {&start_, &newer_, &older_, &rates_, &shared_}) {
      if ((columns == &rates_ || columns == &shared_) && sharing_.empty()) continue;
      columns->resize(inverse_.size(), 2);
      prefer_huge_pages(columns->data(), static_cast<std::size_t>(columns->size()) * sizeof(double));
    }
  }

  Step step(const Instant& from, double length) override {
    const int stages = std::isinf(stable_) ? least_stages : stages_for(length, stable_);
    start(from, length);
    older_.setZero();
    newer_ = first_coefficient(stages) * start_;
    WatchedMean mean(watched_);
    sharing_.empty() ? advance(stages, length, mean) : advance_sharing(stages, length, mean);
    Step result;
    result.change = newer_.col(0);
    rates(newer_, length, older_);  // h L D
    const double estimate = estimate_of(stages);
    result.error.resize(start_.rows());
    for (Eigen::Index row = 0; row < start_.rows(); ++row) {
      const double local = estimate * (start_(row, 0) - newer_(row, 0) - 0.5 * older_(row, 0));
      result.local_error = std::max(result.local_error, std::abs(local));
      result.error[row] = from.error[row] + newer_(row, 1) + local;
    }
    result.stages = {{1, from.time + length, mean.added_to(from.temperature, stages)}};
    return result;
  }

  // The local error of a short step is h^3 T'''/18 at most.
  double first_step(const Instant& from, double allowed) override {
    start({from.time, from.temperature, Eigen::VectorXd::Zero(inverse_.size())}, 1);
    newer_ = start_;
    for (int order = 2; order <= 3; ++order) {
      rates(newer_, 1, older_);
      older_.swap(newer_);
    }
    const double largest = newer_.col(0).lpNorm<Eigen::Infinity>();
    return largest > 0 ? std::cbrt(18 * allowed / largest) : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] double safety() const override { return 1; }
  [[nodiscard]] Sums sums() const override { return Sums::plain; }
  [[nodiscard]] double cost_exponent() const override { return 0.5; }
  [[nodiscard]] std::string name() const override {
    return fmt::format("RKL2 (stabilised explicit, second order) with steps from the tolerance; stable Euler step {:.3g} s",
                       stable_);
  }

 private:
  // h C^-1 F of the temperatures, and of the error, which nothing drives: the flows of both in one product.
  void start(const Instant& from, double length) {
    newer_.col(0) = from.temperature;
    newer_.col(1) = from.error;
    const Eigen::VectorXd driven = balance_.driven(from.temperature, drives_.at(from.time));
    balance_.flows().for_each_flow<2>(newer_.data(), [&](int row, const double* flow) {
      const double scale = length * inverse_[row];
      start_(row, 0) = scale * (driven[row] - flow[0]);
      start_(row, 1) = -scale * (flow[1] + linear_.loss[row] * newer_(row, 1));
    });
    share(start_);
  }

  // h L x.
  void rates(const Columns& x, double length, Columns& result) {
    balance_.flows().for_each_flow<2>(x.data(), [&](int row, const double* flow) {
      const double scale = length * inverse_[row];
      for (int c = 0; c < 2; ++c) result(row, c) = scale * (flow[c] + linear_.loss[row] * x(row, c));
    });
    share(result);
  }

  // Space of fourth order: rates become (1 + C^-1 B) times themselves (fourth_order.h), by a second product each. Nothing to do
  // in second order.
  void share(Columns& rates) {
    if (sharing_.empty()) return;
    sharing_.for_each_flow<2>(rates.data(), [&](int row, const double* flow) {
      Eigen::Map<Pair>(shared_.data() + 2 * static_cast<std::ptrdiff_t>(row)) =
          pair(rates, row) + inverse_[row] * ConstPair(flow);
    });
    rates.swap(shared_);
  }

  // Stages 2 to `stages`, which is odd, each in the place of the one before the last.
  void advance(int stages, double length, WatchedMean& mean) {
    std::vector<Coefficients> with;
    for (int j = 2; j <= stages; ++j) with.push_back(coefficients(j, stages));
    const double* loss = linear_.loss.data();
    const double* inverse = inverse_.data();
    Columns* const columns[] = {&newer_, &older_};  // D_j-1 of product j - 2, in turns
    const auto from = [&](int product) { return columns[product % 2]->data(); };
    balance_.flows().for_each_product<2>(stages - 1, from, [&](int product, int first, int rows) {
      const Coefficients stage = with[static_cast<std::size_t>(product)];
      const Columns& newer = *columns[product % 2];
      mean.advance(product + 2, stage, newer, first, rows);
      return [&, stage, scale = stage.product * length, newer_data = newer.data(), older = columns[(product + 1) % 2]->data(),
              loss, inverse](int row, const double* flow) {
        const std::ptrdiff_t at = 2 * static_cast<std::ptrdiff_t>(row);
        const ConstPair here(newer_data + at);
        Eigen::Map<Pair> increment(older + at);
        increment = stage.mu * here + stage.nu * increment - (scale * inverse[row]) * (ConstPair(flow) + loss[row] * here) +
                    stage.start * pair(start_, row);
      };
    });
  }

  void advance_sharing(int stages, double length, WatchedMean& mean) {
    for (int j = 2; j <= stages; ++j) {
      const Coefficients with = coefficients(j, stages);
      mean.advance(j, with, newer_, 0, static_cast<int>(newer_.rows()));
      rates(newer_, length, rates_);
      older_ = with.mu * newer_ + with.nu * older_ - with.product * rates_ + with.start * start_;
      older_.swap(newer_);
    }
  }

  using Pair = Eigen::Array2d;
  using ConstPair = Eigen::Map<const Pair>;
  static ConstPair pair(const Columns& columns, int row) {
    return ConstPair(columns.data() + 2 * static_cast<std::ptrdiff_t>(row));
  }

  Eigen::VectorXd inverse_;  // of the capacity, 0 for a fixed node [K/J]
  Drives drives_;
  HeatBalance balance_;
  Linearised linear_;    // the same at all times
  double stable_;        // of eq. (8) [s]
  FlowNetwork sharing_;  // B; empty in second order
  std::vector<NodeId> watched_;
  // Of the step: h C^-1 F at its start, and D of the last two stages.
  Columns start_, newer_, older_;
  Columns rates_, shared_;  // in fourth order
};

}  // namespace

std::unique_ptr<TimeScheme> make_stabilised_scheme(const HeatModel& model, std::optional<double> stable) {
  if (!can_be_stabilised(model)) {
    throw InputError(problem("heat.integrator", "stabilised_explicit",
                             "must not be asked to do radiation, or properties, coefficients or conditions that change in time",
                             "Use the implicit integrator"));
  }
  return std::make_unique<StabilisedScheme>(model, stable ? *stable : stable_step(model).step);
}

bool can_be_stabilised(const HeatModel& model) {
  return has_constant_properties(model) && !varies_in_time(model);
}

}  // namespace scree::thermal
