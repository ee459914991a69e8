// Solves with CHOLMOD's factor: what they leave of the right side, what single precision takes away, and that threads change no
// bit.
#include "thermal/supernodal_solve.h"

#include <future>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/SparseCholesky>

#include "engine/base/threads.h"
#include "thermal/direct_factor.h"

namespace scree::thermal {
namespace {

using Matrix = DirectFactor::Matrix;

// Heat conduction between the cells of a box, each with a capacity; conductances differ at random by five orders.
Matrix box_of(int x, int y, int z, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> orders(-2, 3);
  const auto at = [&](int i, int j, int k) { return i + x * (j + y * k); };
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b) {
    const double conductance = std::pow(10, orders(generator));
    for (const auto& [row, column, sign] : {std::tuple(a, a, 1), {b, b, 1}, {std::max(a, b), std::min(a, b), -1}}) {
      entries.emplace_back(row, column, sign * conductance);
    }
  };
  for (int k = 0; k < z; ++k) {
    for (int j = 0; j < y; ++j) {
      for (int i = 0; i < x; ++i) {
        entries.emplace_back(at(i, j, k), at(i, j, k), 1.0);
        if (i > 0) join(at(i, j, k), at(i - 1, j, k));
        if (j > 0) join(at(i, j, k), at(i, j - 1, k));
        if (k > 0) join(at(i, j, k), at(i, j, k - 1));
      }
    }
  }
  Matrix matrix(x * y * z, x * y * z);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Two that have nothing to do with each other.
Matrix side_by_side(const Matrix& a, const Matrix& b) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const Matrix& matrix, Eigen::Index shift) {
    for (int column = 0; column < matrix.cols(); ++column) {
      for (Matrix::InnerIterator entry(matrix, column); entry; ++entry) {
        entries.emplace_back(static_cast<int>(entry.row() + shift), static_cast<int>(entry.col() + shift), entry.value());
      }
    }
  };
  add(a, 0);
  add(b, a.rows());
  Matrix both(a.rows() + b.rows(), a.rows() + b.rows());
  both.setFromTriplets(entries.begin(), entries.end());
  return both;
}

Eigen::MatrixXd right_sides(Eigen::Index rows, int count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> heat(-1, 1);
  Eigen::MatrixXd rhs(rows, count);
  for (double& value : rhs.reshaped()) value = heat(generator);
  return rhs;
}

std::vector<Matrix> matrices() {
  return {box_of(1, 1, 1, 1),    box_of(7, 1, 1, 2),    box_of(9, 8, 1, 3),
          box_of(16, 15, 14, 4), box_of(28, 27, 26, 5), side_by_side(box_of(20, 20, 20, 6), box_of(20, 21, 20, 7))};
}

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

TEST(CholeskyFactors, OfOneAnalysisMadeAtOnceHaveTheBitsOfThoseMadeAlone) {
  const Matrix matrix = box_of(28, 27, 26, 9);
  const Eigen::MatrixXd rhs = right_sides(matrix.rows(), 1);
  const auto made_alone = [&](double scale) {
    const auto factor = make_cholesky();
    factor->factorise(scale * matrix);
    return factor->solve(rhs);
  };
  const Eigen::MatrixXd once = made_alone(1), thrice = made_alone(3);
  const auto first = make_cholesky();
  first->analyse(matrix);
  const auto second = first->another();
  if (!second) GTEST_SKIP() << "this BLAS may not be called by two threads";
  for (int round = 0; round < 5; ++round) {
    auto beside = std::async(std::launch::async, [&] { second->factorise(3 * matrix); });
    first->factorise(matrix);
    beside.get();
    EXPECT_EQ(first->solve(rhs), once);
    EXPECT_EQ(second->solve(rhs), thrice);
  }
}

}  // namespace
}  // namespace scree::thermal
