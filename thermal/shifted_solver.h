// Solves (C + s K) x = b for a few values of s: one symbolic analysis, one numeric factorisation per value.
#pragma once

#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "thermal/heat_model.h"

namespace scree::thermal {

class ShiftedSolver {
 public:
  // C as its diagonal [J/K]; K by its lower triangle, with every diagonal entry present [W/K].
  ShiftedSolver(Eigen::VectorXd capacity, const SparseMatrix& conductance);
  ~ShiftedSolver();

  // Factorises C + shift K unless that is the matrix it has; shift in seconds. Throws RunError if it is not positive definite.
  void prepare(double shift);

  // Each column of `rhs` [J] to its solution [K]. Needs prepare().
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;

  [[nodiscard]] std::int64_t factorisations() const { return factorisations_; }

 private:
  struct Factor;  // keeps CHOLMOD out of this header
  Eigen::VectorXd capacity_;
  SparseMatrix conductance_;
  std::unique_ptr<Factor> factor_;
  double shift_ = -1;
  std::int64_t factorisations_ = 0;
};

}  // namespace scree::thermal
