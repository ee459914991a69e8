// Solves (C + s J) x = b for the free nodes: one symbolic analysis, one numeric factorisation per matrix.
//
// J = K + diag(loss) is symmetric: supernodal Cholesky (CHOLMOD). With a conductivity that depends on temperature, J = K + U
// diag(k)
// + diag(loss) is not: LU of the same pattern (UMFPACK).
#pragma once

#include <cstdint>
#include <memory>

#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

class HeatSolver {
 public:
  HeatSolver(const HeatModel& model, const FreeNodes& free);  // refers to the free nodes
  ~HeatSolver();

  // Factorises C + scale J [J/K]; scale in seconds. Throws RunError if that cannot be done.
  void prepare(const Linearised& at, double scale);

  // Finds out what a factorisation will cost; the symbolic part of it, which prepare() then has no more to do. Symmetric J.
  FactorSize analyse(const Linearised& at);

  // Factorises J alone [W/K].
  void prepare_steady(const Linearised& at);

  // Each column of `rhs` [J] to its solution [K]. Needs prepare().
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;

  [[nodiscard]] std::int64_t factorisations() const { return factorisations_; }
  [[nodiscard]] std::string name() const;

 private:
  struct Factor;  // keeps the libraries out of this header
  [[nodiscard]] SparseMatrix matrix_of(const Eigen::VectorXd& diagonal, const Linearised& at, double scale) const;
  void factorise(const Eigen::VectorXd& diagonal, const Linearised& at, double scale);

  const FreeNodes& free_;
  SparseMatrix conductance_;       // of the free nodes: its lower triangle, or all of it beside U
  SparseMatrix unit_conductance_;  // all of U's
  std::unique_ptr<Factor> factor_;
  std::int64_t factorisations_ = 0;
};

}  // namespace scree::thermal
