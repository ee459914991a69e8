#include "thermal/free_nodes.h"

namespace scree::thermal {

Eigen::VectorXd inverse_capacity(const HeatModel& model, const Eigen::VectorXd& capacity) {
  Eigen::VectorXd inverse = capacity.cwiseInverse();
  for (const NodeId node : model.fixed_nodes) inverse[node.value()] = 0;
  return inverse;
}

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
  return part(matrix, false);
}

SparseMatrix FreeNodes::lower_block(const SparseMatrix& matrix) const {
  return part(matrix, true);
}

SparseMatrix FreeNodes::part(const SparseMatrix& matrix, bool lower) const {
  SparseMatrix part(size(), size());
  part.reserve(lower ? (matrix.nonZeros() + matrix.rows()) / 2 + size() : matrix.nonZeros() + size());
  for (Eigen::Index column = 0; column < size(); ++column) {
    part.startVec(column);
    bool diagonal = false;  // whether it has been entered
    for (SparseMatrix::InnerIterator entry(matrix, nodes_[column]); entry; ++entry) {
      const Eigen::Index row = unknowns_[entry.row()];
      if (row < 0 || (lower && row < column)) continue;
      if (!diagonal && row > column) part.insertBack(column, column) = 0;
      diagonal = diagonal || row >= column;
      part.insertBack(row, column) = entry.value();
    }
    if (!diagonal) part.insertBack(column, column) = 0;
  }
  part.finalize();
  return part;
}

}  // namespace scree::thermal
