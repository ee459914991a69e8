// Solves with a supernodal factor: what they leave of the right side, what single precision takes away, and that threads change
// no bit.
#include "thermal/supernodal_solve.h"

#include <gtest/gtest.h>
#include <Eigen/SparseCholesky>

#include "engine/base/threads.h"
#include "tests/thermal/boxes.h"
#include "thermal/direct_factor.h"

namespace scree::thermal {
namespace {

using namespace test;

TEST(SupernodalSolve, LeavesNothingOfTheRightSidesButRounding) {
  for (const Matrix& matrix : matrices()) {
    const auto factor = make_cholesky();
    factor->factorise(matrix);
    for (const int sides : {1, 2, 5}) {
      const Eigen::MatrixXd rhs = right_sides(matrix.rows(), sides);
      const Eigen::MatrixXd left = rhs - matrix.selfadjointView<Eigen::Lower>() * factor->solve(rhs);
      EXPECT_LT(left.lpNorm<Eigen::Infinity>(), 1e-10) << matrix.rows() << " unknowns, " << sides << " right sides";
    }
  }
}

TEST(SupernodalSolve, IsThatOfAnotherFactorisation) {
  for (const Matrix& matrix : matrices()) {
    const auto factor = make_cholesky();
    factor->factorise(matrix);
    const Eigen::SimplicialLLT<Matrix> other(matrix);
    const Eigen::MatrixXd rhs = right_sides(matrix.rows(), 2);
    EXPECT_LT((factor->solve(rhs) - other.solve(rhs)).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

// The largest difference, of the largest number.
double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

// Heat that is even everywhere warms all evenly, and there what is rounded of the large conductances tells most.
TEST(SupernodalSolve, EstimatesAreTheSolutionToThreeDigits) {
  for (const Matrix& matrix : matrices()) {
    const auto factor = make_cholesky();
    factor->factorise(matrix);
    for (const int sides : {1, 2, 5}) {
      Eigen::MatrixXd rhs = right_sides(matrix.rows(), sides);
      rhs.array() += 1;
      EXPECT_LT(relative_difference(factor->estimate(rhs), factor->solve(rhs)), 1e-3) << matrix.rows() << " unknowns";
    }
  }
}

// Of steps so short that what fills the factor is too small for single precision.
TEST(SupernodalSolve, EstimatesOfMatricesThatAreNearlyDiagonalAreTheSolutionToSixDigits) {
  Matrix matrix = box_of(16, 15, 14, 9);
  matrix *= 1e-25;
  matrix.diagonal().array() += 1;
  const auto factor = make_cholesky();
  factor->factorise(matrix);
  const Eigen::MatrixXd rhs = right_sides(matrix.rows(), 2);
  EXPECT_LT(relative_difference(factor->estimate(rhs), factor->solve(rhs)), 1e-6);
}

TEST(SupernodalSolve, DependsOnNoNumberOfThreadsAndNotOnWhatIsSolvedBesideIt) {
  const Matrix matrix = matrices().back();
  const auto factor = make_cholesky();
  factor->factorise(matrix);
  const Eigen::MatrixXd rhs = right_sides(matrix.rows(), 2);
  const int threads = threads_in_use();
  use_threads(1);
  const Eigen::MatrixXd by_one = factor->solve(rhs);
  const Eigen::MatrixXd alone = factor->solve(rhs.col(1));
  const Eigen::MatrixXd estimated = factor->estimate(rhs);
  for (const int count : {2, 3, 8}) {
    use_threads(count);
    EXPECT_EQ(factor->solve(rhs), by_one) << count << " threads";
    EXPECT_EQ(factor->estimate(rhs), estimated) << count << " threads";
  }
  use_threads(threads);
  EXPECT_EQ(alone, by_one.col(1));
}

TEST(SupernodalSolve, TakesTheNextMatrixOfTheSamePattern) {
  const Matrix matrix = box_of(20, 20, 20, 8);
  const auto factor = make_cholesky();
  factor->factorise(matrix);
  const Eigen::MatrixXd rhs = right_sides(matrix.rows(), 1);
  const Eigen::MatrixXd first = factor->solve(rhs), estimated = factor->estimate(rhs);
  factor->factorise(2 * matrix);
  EXPECT_LT((2 * factor->solve(rhs) - first).lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_LT((2 * factor->estimate(rhs) - estimated).lpNorm<Eigen::Infinity>(), 1e-6);
}

}  // namespace
}  // namespace scree::thermal
