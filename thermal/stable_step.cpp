#include "thermal/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/threads.h"
#include "thermal/drive.h"
#include "thermal/fourth_order.h"
#include "thermal/heat_balance.h"

namespace scree::thermal {

namespace {

constexpr int most_rounds = 20;
constexpr double worth_a_round = 0.005;  // of the bound
constexpr double least_weight = 1e-6;    // of the largest: any positive ones will do, and these do not vanish

// |A| w and how large it is beside w.
class Magnitudes {
 public:
  explicit Magnitudes(const HeatModel& model)
      : conductance_(model.conductance),
        loss_(loss_to_surroundings(model, model.initial, Drives(model).at(0))),
        inverse_(model.capacity.cwiseInverse()) {
    for (const NodeId node : model.fixed_nodes) inverse_[node.value()] = 0;
  }

  // The largest rate at which a node loses heat to surroundings [1/s].
  [[nodiscard]] double largest_loss() const { return inverse_.size() > 0 ? inverse_.cwiseProduct(loss_).maxCoeff() : 0; }

  [[nodiscard]] Eigen::VectorXd equal_weights() const { return (inverse_.array() > 0).cast<double>(); }

  // Fixed nodes have no weight. Returns the largest quotient.
  double multiply(const Eigen::VectorXd& weights, Eigen::VectorXd& product) const {
    const int* begin = conductance_.outerIndexPtr();
    const int* column = conductance_.innerIndexPtr();
    const double* value = conductance_.valuePtr();
    double largest = 0;
#pragma omp parallel for schedule(static) reduction(max : largest) if (weights.size() >= rows_worth_sharing)
    for (Eigen::Index row = 0; row < weights.size(); ++row) {
      double sum = loss_[row] * weights[row];
      for (int k = begin[row]; k < begin[row + 1]; ++k) sum += std::abs(value[k]) * weights[column[k]];
      product[row] = inverse_[row] * sum;
      if (weights[row] > 0) largest = std::max(largest, product[row] / weights[row]);
    }
    return largest;
  }

 private:
  const SparseMatrix& conductance_;
  Eigen::VectorXd loss_;
  Eigen::VectorXd inverse_;  // of the capacity, 0 for a fixed node [K/J]
};

}  // namespace

StableStep stable_step(const HeatModel& model) {
  const Magnitudes magnitudes(model);
  Eigen::VectorXd weights = magnitudes.equal_weights();
  Eigen::VectorXd product(weights.size());
  double bound = std::numeric_limits<double>::infinity();
  Eigen::Index fastest = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const double before = bound;
    bound = std::min(bound, magnitudes.multiply(weights, product));
    const double most = product.size() > 0 ? product.maxCoeff(&fastest) : 0;
    if (most == 0) return {std::numeric_limits<double>::infinity(), NodeId{}};
    if (bound > (1 - worth_a_round) * before) break;
    weights = (weights.array() > 0).select((product / most).cwiseMax(least_weight), 0.0);
  }
  if (model.fastest_cell) bound = std::min(bound, model.fastest_cell->rate + magnitudes.largest_loss());
  return {2 / (largest_gain(model) * bound), NodeId{static_cast<std::size_t>(fastest)}};
}

}  // namespace scree::thermal
