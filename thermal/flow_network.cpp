#include "thermal/flow_network.h"

namespace scree::thermal {

FlowNetwork::FlowNetwork(const SparseMatrix& conductance) : size_(conductance.rows()) {
  links_.reserve(static_cast<std::size_t>(conductance.nonZeros()) / 2);
  for (int column = 0; column < conductance.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(conductance, column); entry; ++entry) {
      if (entry.row() > column) links_.push_back({static_cast<int>(entry.row()), column, -entry.value()});
    }
  }
}

Eigen::VectorXd FlowNetwork::leaving(const Eigen::VectorXd& temperature) const {
  std::vector<long double> heat(static_cast<std::size_t>(size_), 0);
  for (const Link& link : links_) {
    const double flow = link.conductance * (temperature[link.first] - temperature[link.second]);
    heat[link.first] += flow;
    heat[link.second] -= flow;
  }
  Eigen::VectorXd rounded(size_);
  for (Eigen::Index i = 0; i < size_; ++i) rounded[i] = static_cast<double>(heat[i]);
  return rounded;
}

}  // namespace scree::thermal
