#include "thermal/kirchhoff_matrix.h"

#include <vector>

namespace scree::thermal {

namespace {

// Of the nodes that conduct by U, by their material; 1 of a material that has none [W/m/K].
std::vector<double> mean_conductivities(const VaryingProperties& properties, const Eigen::VectorXd& unit_diagonal,
                                        const Eigen::VectorXd& conductivity) {
  std::vector<double> sums(properties.conductivity.size(), 0.0), counts(sums.size(), 0.0);
  for (const NodeId node : properties.material.ids()) {
    if (unit_diagonal[node.value()] == 0) continue;
    const auto material = static_cast<std::size_t>(properties.material[node]);
    sums[material] += conductivity[node.value()];
    ++counts[material];
  }
  for (std::size_t m = 0; m < sums.size(); ++m) sums[m] = counts[m] > 0 ? sums[m] / counts[m] : 1;
  return sums;
}

}  // namespace

bool is_symmetric(const HeatModel& model) {
  return !model.varying || model.varying->unit_conductance.nonZeros() == 0;
}

KirchhoffMatrix::KirchhoffMatrix(const HeatModel& model)
    : model_(model),
      balance_(model, Sums::plain),
      unit_diagonal_(model.varying->unit_conductance.diagonal()),
      near_(model.conductance + model.varying->unit_conductance) {
  conduction_.loss = Eigen::VectorXd::Zero(model.capacity.size());
}

void KirchhoffMatrix::set(const Eigen::VectorXd& conductivity) {
  conduct_by(conductivity);
  const VaryingProperties& properties = *model_.varying;
  const std::vector<double> means = mean_conductivities(properties, unit_diagonal_, conductivity);
  Eigen::VectorXd kappa = Eigen::VectorXd::Zero(conductivity.size());
  per_variable_ = Eigen::VectorXd::Ones(conductivity.size());
  for (const NodeId node : properties.material.ids()) {
    if (unit_diagonal_[node.value()] == 0) continue;
    kappa[node.value()] = means[static_cast<std::size_t>(properties.material[node])];
    per_variable_[node.value()] = kappa[node.value()] / conductivity[node.value()];
  }
  near_ = model_.conductance + SparseMatrix(properties.unit_conductance * kappa.asDiagonal());
}

}  // namespace scree::thermal
