#include "thermal/free_nodes.h"

namespace scree::thermal {

FreeNodes::FreeNodes(const HeatModel& model) : unknowns_(static_cast<std::size_t>(model.capacity.size()), 0) {
  for (const NodeId node : model.fixed_nodes) unknowns_[node.index()] = -1;
  for (std::size_t node = 0; node < unknowns_.size(); ++node) {
    if (unknowns_[node] < 0) continue;
    unknowns_[node] = size();
    nodes_.push_back(static_cast<Eigen::Index>(node));
  }
}

Eigen::MatrixXd FreeNodes::gather(const Eigen::MatrixXd& all) const {
  Eigen::MatrixXd free(size(), all.cols());
  for (Eigen::Index i = 0; i < size(); ++i) free.row(i) = all.row(nodes_[i]);
  return free;
}

Eigen::MatrixXd FreeNodes::scatter(const Eigen::MatrixXd& free) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns_.size()), free.cols());
  for (Eigen::Index i = 0; i < size(); ++i) all.row(nodes_[i]) = free.row(i);
  return all;
}

SparseMatrix FreeNodes::block(const SparseMatrix& matrix) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()) + nodes_.size());
  for (Eigen::Index column = 0; column < size(); ++column) {
    entries.emplace_back(static_cast<int>(column), static_cast<int>(column), 0.0);
    for (SparseMatrix::InnerIterator entry(matrix, nodes_[column]); entry; ++entry) {
      const Eigen::Index row = unknowns_[entry.row()];
      if (row >= 0) entries.emplace_back(static_cast<int>(row), static_cast<int>(column), entry.value());
    }
  }
  SparseMatrix block(size(), size());
  block.setFromTriplets(entries.begin(), entries.end());
  return block;
}

SparseMatrix FreeNodes::lower_block(const SparseMatrix& matrix) const {
  return block(matrix).triangularView<Eigen::Lower>();
}

}  // namespace scree::thermal
