// The matrix of a balance whose conductivities depend on temperature, M = C + s J with J = K + U diag(k) + diag(loss)
// (heat_balance.h), is not symmetric. Kirchhoff's variable y = D x makes it so where heat is conducted in blocks: with
// D = k/kappa, kappa [W/m/K] the mean k of a material, and D = 1 at nodes without U,
//   M D^-1 = (C + s diag(loss)) D^-1 + s (U diag(kappa) + K D^-1).
// What is left is K D^-1: joints between nodes of unlike D. So
//   S = (C + s diag(loss)) D^-1 + s (U diag(kappa) + K)
// (U couples nodes of one material) is factorised in its place, symmetric and positive definite, and an iteration takes away
// the rest (conjugate_residuals.h). However stiff a joint is, S loses as little heat there as M does, so S^-1 M stays of the
// size of D. D^-1/2 K D^-1/2 would not do: across a joint of beta 1000 between two materials whose D differ it took more than
// sixty iterations.
#pragma once

#include "thermal/heat_balance.h"

namespace scree::thermal {

// Whether J is symmetric: no conductivity depends on temperature, and there is no U.
bool is_symmetric(const HeatModel& model);

class KirchhoffMatrix {
 public:
  explicit KirchhoffMatrix(const HeatModel& model);  // refers to it

  // Takes conductivities, one of each node [W/m/K].
  void set(const Eigen::VectorXd& conductivity);
  // Takes them for M alone: S and D stay.
  void conduct_by(const Eigen::VectorXd& conductivity) { conduction_.conductivity = conductivity; }

  // S without its diagonal of C and loss, at s = 1 [W/K]; its pattern stays. Of K + U, whatever D is, before set().
  [[nodiscard]] const SparseMatrix& near() const { return near_; }

  // D^-1 of each node.
  [[nodiscard]] const Eigen::VectorXd& per_variable() const { return per_variable_; }

  // (K + U diag(k)) x, of the conductivities that were set [W].
  [[nodiscard]] Eigen::VectorXd conducted(const Eigen::VectorXd& x) const { return balance_.lost(x, conduction_); }

 private:
  const HeatModel& model_;
  HeatBalance balance_;
  Eigen::VectorXd unit_diagonal_;  // of U: 0 at nodes without [m]
  SparseMatrix near_;
  Eigen::VectorXd per_variable_;
  Linearised conduction_;  // alone: nothing is lost to surroundings
};

}  // namespace scree::thermal
