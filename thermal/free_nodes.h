// The unknowns: nodes that no boundary holds. Fixed nodes are eliminated, not penalised.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// 1/C of the free nodes; 0 of fixed ones, which is as good as an infinite capacity [K/J].
Eigen::VectorXd inverse_capacity(const HeatModel& model, const Eigen::VectorXd& capacity);

class FreeNodes {
 public:
  explicit FreeNodes(const HeatModel& model);

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(nodes_.size()); }
  [[nodiscard]] Eigen::Index node(Eigen::Index unknown) const { return nodes_[unknown]; }
  [[nodiscard]] Eigen::Index unknown(Eigen::Index node) const { return unknowns_[node]; }  // -1 of a fixed one

  // The free rows of `all`, and back; fixed rows become zero.
  [[nodiscard]] Eigen::MatrixXd gather(const Eigen::MatrixXd& all) const;
  [[nodiscard]] Eigen::MatrixXd scatter(const Eigen::MatrixXd& free) const;

  // `matrix` between free nodes, all of it or its lower triangle; every diagonal entry is present.
  [[nodiscard]] SparseMatrix block(const SparseMatrix& matrix) const;
  [[nodiscard]] SparseMatrix lower_block(const SparseMatrix& matrix) const;

 private:
  [[nodiscard]] SparseMatrix part(const SparseMatrix& matrix, bool lower) const;

  std::vector<Eigen::Index> nodes_;     // of each unknown, ascending
  std::vector<Eigen::Index> unknowns_;  // of each node, -1 for a fixed one
};

}  // namespace scree::thermal
