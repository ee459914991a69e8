// Factorisations of sparse matrices by CHOLMOD and UMFPACK, in a library of their own (libscree_factor.so) that is loaded by
// the first of them: with BLAS and LAPACK behind it, it takes as long to load as a small run that needs none takes in all. What
// CHOLMOD has factorised is solved with here (supernodal_solve.h).
#pragma once

#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "thermal/solver_cost.h"
#include "thermal/supernodal_solve.h"

namespace scree::thermal {

class DirectFactor {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  DirectFactor() = default;
  virtual ~DirectFactor() = default;
  DirectFactor(const DirectFactor&) = delete;
  DirectFactor& operator=(const DirectFactor&) = delete;

  // The symbolic part; its size if that is known before the numeric one.
  virtual FactorSize analyse(const Matrix& matrix) = 0;
  // A matrix of the pattern that was analysed, or of the first if none was.
  virtual void factorise(const Matrix& matrix) = 0;
  // Needs factorise().
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) = 0;
  // The same by the factor's values rounded to single precision, if there are any: half as much to read.
  virtual Eigen::MatrixXd estimate(const Eigen::MatrixXd& rhs) { return solve(rhs); }
  // One more of the same analysis, which may factorise while this one does; none if that cannot be. Needs analyse().
  [[nodiscard]] virtual std::unique_ptr<DirectFactor> another() const { return nullptr; }
  [[nodiscard]] virtual bool sound() const = 0;
};

// What CHOLMOD does of a Cholesky factorisation.
class CholeskyFactor {
 public:
  using Matrix = DirectFactor::Matrix;

  CholeskyFactor() = default;
  virtual ~CholeskyFactor() = default;
  CholeskyFactor(const CholeskyFactor&) = delete;
  CholeskyFactor& operator=(const CholeskyFactor&) = delete;

  virtual FactorSize analyse(const Matrix& matrix) = 0;
  virtual void factorise(const Matrix& matrix) = 0;
  [[nodiscard]] virtual bool sound() const = 0;
  // After analyse(), unless there is no memory for it: where factorise() puts the values of the factor, for all matrices.
  // Nothing has been written there yet.
  virtual double* make_room() = 0;
  // After make_room().
  [[nodiscard]] virtual SupernodalPattern pattern() const = 0;
  // As DirectFactor::another(); before factorise().
  [[nodiscard]] virtual CholeskyFactor* another() const = 0;
};

// Supernodal Cholesky; reads the lower triangle. Both throw RunError if the library is not there.
std::unique_ptr<DirectFactor> make_cholesky();
// LU.
std::unique_ptr<DirectFactor> make_lu();

}  // namespace scree::thermal

// What the library exports; the caller owns what they return.
extern "C" scree::thermal::CholeskyFactor* scree_make_cholesky();
extern "C" scree::thermal::DirectFactor* scree_make_lu();
