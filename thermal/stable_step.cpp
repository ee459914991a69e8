#include "thermal/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/phases.h"
#include "thermal/drive.h"
#include "thermal/fourth_order.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"

namespace scree::thermal {

namespace {

constexpr int most_rounds = 20;
constexpr double worth_a_round = 0.005;  // of the bound
constexpr double least_weight = 1e-6;    // of the largest: any positive ones will do, and these do not vanish

// |A| w and how large it is beside w.
class Magnitudes {
 public:
  Magnitudes(const HeatModel& model, const Linearised& state)
      : conductance_(model.conductance),
        unit_conductance_(state.conductivity.size() > 0 ? &model.varying->unit_conductance : nullptr),
        state_(state),
        inverse_(inverse_capacity(model, state.capacity)) {}

  // The largest rate at which a node loses heat to surroundings [1/s].
  [[nodiscard]] double largest_loss() const { return inverse_.size() > 0 ? inverse_.cwiseProduct(state_.loss).maxCoeff() : 0; }

  [[nodiscard]] Eigen::VectorXd equal_weights() const { return (inverse_.array() > 0).cast<double>(); }

  // Fixed nodes have no weight. Returns the largest quotient.
  double multiply(const Eigen::VectorXd& weights, Eigen::VectorXd& product) const {
    return largest_of_each(weights.size(), [&](Eigen::Index row) {
      double sum = state_.loss[row] * weights[row];
      add(
          conductance_, row, [&](int column) { return weights[column]; }, sum);
      if (unit_conductance_ != nullptr) {
        add(
            *unit_conductance_, row, [&](int column) { return state_.conductivity[column] * weights[column]; }, sum);
      }
      product[row] = inverse_[row] * sum;
      return weights[row] > 0 ? product[row] / weights[row] : 0.0;
    });
  }

 private:
  template <class Weight>
  static void add(const SparseMatrix& matrix, Eigen::Index row, const Weight& weight, double& sum) {
    const int* column = matrix.innerIndexPtr();
    const double* value = matrix.valuePtr();
    for (int k = matrix.outerIndexPtr()[row]; k < matrix.outerIndexPtr()[row + 1]; ++k) {
      sum += std::abs(value[k]) * weight(column[k]);
    }
  }

  const SparseMatrix& conductance_;
  const SparseMatrix* unit_conductance_;  // where a conductivity depends on temperature
  const Linearised& state_;
  Eigen::VectorXd inverse_;  // of the capacity, 0 for a fixed node [K/J]
};

Linearised initial_state(const HeatModel& model) {
  return HeatBalance(model).linearised(model.initial, Drives(model).at(0));
}

}  // namespace

StableSteps::StableSteps(const HeatModel& model) : model_(&model) {
  const Linearised state = initial_state(model);
  const Magnitudes magnitudes(model, state);
  Eigen::VectorXd weights = magnitudes.equal_weights();
  Eigen::VectorXd product(weights.size());
  double bound = std::numeric_limits<double>::infinity();
  Eigen::Index fastest = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const double before = bound;
    const double quotient = magnitudes.multiply(weights, product);
    if (quotient < bound && !has_constant_properties(model)) weights_ = weights;
    bound = std::min(bound, quotient);
    const double most = product.size() > 0 ? product.maxCoeff(&fastest) : 0;
    if (most == 0) {
      at_start_ = {std::numeric_limits<double>::infinity(), NodeId{}};
      return;
    }
    if (bound > (1 - worth_a_round) * before) break;
    weights = (weights.array() > 0).select((product / most).cwiseMax(least_weight), 0.0);
  }
  const bool grid = model.fastest_cell && !model.varying;
  if (grid) bound = std::min(bound, model.fastest_cell->rate + magnitudes.largest_loss());
  at_start_ = {2 / (largest_gain(model) * bound), NodeId{static_cast<std::size_t>(fastest)}};
}

double StableSteps::at(const Linearised& state) const {
  const Magnitudes magnitudes(*model_, state);
  Eigen::VectorXd product(weights_.size());
  const double bound = magnitudes.multiply(weights_, product);
  return bound > 0 ? 2 / bound : std::numeric_limits<double>::infinity();
}

}  // namespace scree::thermal
