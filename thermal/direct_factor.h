// Factorisations of sparse matrices. CHOLMOD and BLAS stand in a library of their own (libscree_factor.so) that is
// loaded by the first of them: it takes as long to load as a small run that needs none takes in all. CHOLMOD orders and
// analyses; numbers are factorised and solved with here, on all threads (supernodal_factor.h, supernodal_solve.h).
#pragma once

#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "thermal/dense_kernels.h"
#include "thermal/solver_cost.h"
#include "thermal/supernodal_pattern.h"

namespace scree::thermal {

class DirectFactor {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  DirectFactor() = default;
  virtual ~DirectFactor() = default;
  DirectFactor(const DirectFactor&) = delete;
  DirectFactor& operator=(const DirectFactor&) = delete;

  // The symbolic part.
  virtual FactorSize analyse(const Matrix& matrix) = 0;
  // A matrix of the pattern that was analysed, or of the first if none was.
  virtual void factorise(const Matrix& matrix) = 0;
  // Needs factorise().
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) = 0;
  // The same by the factor's values rounded to single precision: half as much to read.
  virtual Eigen::MatrixXd estimate(const Eigen::MatrixXd& rhs) = 0;
  [[nodiscard]] virtual bool sound() const = 0;
};

// What CHOLMOD and BLAS do of a Cholesky factorisation: the symbolic part, and what is dense.
class CholeskyAnalysis {
 public:
  using Matrix = DirectFactor::Matrix;

  CholeskyAnalysis() = default;
  virtual ~CholeskyAnalysis() = default;
  CholeskyAnalysis(const CholeskyAnalysis&) = delete;
  CholeskyAnalysis& operator=(const CholeskyAnalysis&) = delete;

  virtual FactorSize analyse(const Matrix& matrix) = 0;
  // After analyse(), if that was possible.
  [[nodiscard]] virtual SupernodalPattern pattern() const = 0;
  [[nodiscard]] virtual DenseKernels kernels() const = 0;
};

// Supernodal Cholesky; reads the lower triangle. Throws RunError if the library is not there.
std::unique_ptr<DirectFactor> make_cholesky();

}  // namespace scree::thermal

// What the library exports; the caller owns what they return.
extern "C" scree::thermal::CholeskyAnalysis* scree_make_cholesky();
