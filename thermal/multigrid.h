// Conjugate gradients preconditioned by algebraic multigrid (BoomerAMG of hypre) for a matrix with the pattern of K: memory and
// time in proportion to its entries, where a factorisation of a solid takes some n^(4/3) and n^2.
#pragma once

#include <cstdint>
#include <memory>

#include "thermal/free_nodes.h"

namespace scree::thermal {

class Multigrid {
 public:
  // Refers to both. Throws RunError if there is no hypre.
  Multigrid(const SparseMatrix& conductance, const FreeNodes& free);
  ~Multigrid();

  // scale K + diag(diagonal) of the free nodes, positive definite. Throws RunError if hypre fails. The first of them starts
  // it, and with it MPI, which stays with the thread that does so.
  void prepare(const Eigen::VectorXd& diagonal, double scale);

  // Until the residual is `accuracy` of the right side, both in the energy norm of the preconditioner. Needs prepare().
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& rhs, double accuracy);

  [[nodiscard]] std::int64_t iterations() const { return iterations_; }  // in all

 private:
  struct Hypre;  // keeps the library out of this header
  const SparseMatrix& conductance_;
  const FreeNodes& free_;
  std::unique_ptr<Hypre> hypre_;
  std::int64_t iterations_ = 0;
};

}  // namespace scree::thermal
