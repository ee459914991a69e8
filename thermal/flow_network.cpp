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
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(size_);
  for (const Link& link : links_) {
    const double flow = link.conductance * (temperature[link.first] - temperature[link.second]);
    heat[link.first] += flow;
    heat[link.second] -= flow;
  }
  return heat;
}

}  // namespace scree::thermal
