#include "thermal/flow_network.h"

#include "engine/base/threads.h"

namespace scree::thermal {

namespace {

// Columns are rows: the matrix is symmetric.
template <class Sum>
Eigen::VectorXd summed(const SparseMatrix& matrix, const Eigen::VectorXd& temperature) {
  Eigen::VectorXd heat(temperature.size());
#pragma omp parallel for schedule(static) if (heat.size() >= rows_worth_sharing)
  for (Eigen::Index row = 0; row < heat.size(); ++row) {
    Sum sum = 0;
    for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
      sum += entry.value() * (temperature[entry.row()] - temperature[row]);
    }
    heat[row] = static_cast<double>(sum);
  }
  return heat;
}

}  // namespace

Eigen::VectorXd FlowNetwork::leaving(const Eigen::VectorXd& temperature) const {
  if (empty()) return Eigen::VectorXd::Zero(temperature.size());
  return sums_ == Sums::plain ? summed<double>(*conductance_, temperature) : summed<long double>(*conductance_, temperature);
}

}  // namespace scree::thermal
