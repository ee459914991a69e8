#include "thermal/flow_network.h"

#include "engine/base/phases.h"

namespace scree::thermal {

namespace {

// Columns are rows: the matrix is symmetric.
template <class Sum>
double row_sum(const SparseMatrix& matrix, Eigen::Index row, const Eigen::VectorXd& temperature) {
  Sum sum = 0;
  for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
    sum += entry.value() * (temperature[entry.row()] - temperature[row]);
  }
  return static_cast<double>(sum);
}

Eigen::VectorXd plainly(const RowRuns& rows, const Eigen::VectorXd& temperature) {
  Eigen::VectorXd heat(temperature.size());
  rows.for_each_flow<1>(temperature.data(), [&](int row, const double* flow) { heat[row] = *flow; });
  return heat;
}

Eigen::VectorXd extended(const SparseMatrix& matrix, const Eigen::VectorXd& temperature) {
  Eigen::VectorXd heat(temperature.size());
  for_each_shortly(heat.size(), [&](Eigen::Index row) { heat[row] = row_sum<long double>(matrix, row, temperature); });
  return heat;
}

}  // namespace

FlowNetwork::FlowNetwork(const SparseMatrix* conductance, Sums sums) : conductance_(conductance), sums_(sums) {}

const RowRuns& FlowNetwork::rows() const {
  // A matrix without entries has rows all the same: of lumped blocks that nothing joins.
  if (!rows_) rows_.emplace(*conductance_);
  return *rows_;
}

Eigen::VectorXd FlowNetwork::leaving(const Eigen::VectorXd& temperature) const {
  if (empty()) return Eigen::VectorXd::Zero(temperature.size());
  return sums_ == Sums::plain ? plainly(rows(), temperature) : extended(*conductance_, temperature);
}

double FlowNetwork::leaving(NodeId node, const Eigen::VectorXd& temperature) const {
  if (empty()) return 0;
  return sums_ == Sums::plain ? row_sum<double>(*conductance_, node.value(), temperature)
                              : row_sum<long double>(*conductance_, node.value(), temperature);
}

}  // namespace scree::thermal
