// Factors against dense ones, what is not positive definite, and that neither threads nor earlier matrices change a bit.
#include "thermal/supernodal_factor.h"

#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "engine/base/threads.h"
#include "tests/thermal/boxes.h"
#include "thermal/direct_factor.h"

namespace scree::thermal {
namespace {

using namespace test;

// Kernels by Eigen, which one thread calls.
using Columns = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using Given = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

void multiply(int rows, int columns, int inner, double alpha, const double* a, int a_ld, const double* b, int b_ld, double beta,
              double* c, int c_ld) {
  Columns result(c, rows, columns, Eigen::OuterStride<>(c_ld));
  if (beta == 0) result.setZero();
  result += alpha * Given(a, rows, inner, Eigen::OuterStride<>(a_ld)) *
            Given(b, columns, inner, Eigen::OuterStride<>(b_ld)).transpose();
}

void square(int rows, int inner, double alpha, const double* a, int a_ld, double beta, double* c, int c_ld) {
  Columns result(c, rows, rows, Eigen::OuterStride<>(c_ld));
  const Given factor(a, rows, inner, Eigen::OuterStride<>(a_ld));
  if (beta == 0) result.setZero();
  result.triangularView<Eigen::Lower>() += alpha * factor * factor.transpose();
}

bool factorise(int rows, double* a, int ld) {
  Columns matrix(a, rows, rows, Eigen::OuterStride<>(ld));
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  matrix.triangularView<Eigen::Lower>() = factor.matrixLLT();
  return factor.info() == Eigen::Success;
}

void divide(int rows, int columns, const double* l, int l_ld, double* b, int b_ld) {
  Columns result(b, rows, columns, Eigen::OuterStride<>(b_ld));
  const Given factor(l, columns, columns, Eigen::OuterStride<>(l_ld));
  factor.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(result);
}

const DenseKernels by_eigen{multiply, square, factorise, divide, false};

// Four supernodes, whose rows in those above have gaps: of the last, columns 3 and 4 of the factor, the first has row 4 alone,
// the second row 3 alone, the third both. Unknowns are in another order.
class Arrow : public testing::Test {
 protected:
  Arrow() {
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(5, 5);
    full.diagonal() << 9, 8, 7, 6, 5;
    for (const auto& [row, column, value] : {std::tuple(4, 0, -2.0), {3, 1, -1.5}, {3, 2, -1.0}, {4, 2, -0.5}}) {
      full(row, column) = full(column, row) = value;
    }
    exact = full.llt().matrixL();
    const Eigen::MatrixXd shuffled = Eigen::PermutationMatrix<5>(Eigen::Vector<int, 5>(2, 0, 4, 1, 3)) * full *
                                     Eigen::PermutationMatrix<5>(Eigen::Vector<int, 5>(2, 0, 4, 1, 3)).transpose();
    lower = Matrix(Eigen::MatrixXd(shuffled.triangularView<Eigen::Lower>()).sparseView());
  }

  const std::vector<int> first{0, 1, 2, 3, 5}, rows_begin{0, 2, 4, 7, 9}, rows{0, 4, 1, 3, 2, 3, 4, 3, 4};
  const std::vector<int> values_begin{0, 2, 4, 7, 11}, permutation{2, 0, 4, 1, 3};
  const SupernodalPattern pattern{5, 4, first.data(), rows_begin.data(), rows.data(), values_begin.data(), permutation.data()};
  Eigen::MatrixXd exact;
  Matrix lower;
};

TEST_F(Arrow, HasTheFactorOfTheDenseMatrix) {
  std::vector<double> values(11, std::numeric_limits<double>::quiet_NaN());
  ASSERT_TRUE(SupernodalFactor(pattern, lower, by_eigen).factorise(lower, values.data()));
  for (int s = 0; s < pattern.supernodes; ++s) {
    for (int j = 0; j < pattern.columns_of(s); ++j) {
      for (int i = j; i < pattern.rows_of(s); ++i) {
        const double value = values[pattern.values_begin[s] + j * pattern.rows_of(s) + i];
        EXPECT_NEAR(value, exact(pattern.row(s, i), pattern.first[s] + j), 1e-15)
            << "supernode " << s << ", " << i << ", " << j;
      }
    }
  }
}

TEST_F(Arrow, IsNotFactorisedWhereItIsNotPositiveDefinite) {
  const SupernodalFactor factor(pattern, lower, by_eigen);
  std::vector<double> values(11);
  for (int unknown = 0; unknown < 5; ++unknown) {
    Matrix indefinite = lower;
    indefinite.coeffRef(unknown, unknown) = -1;
    EXPECT_FALSE(factor.factorise(indefinite, values.data())) << "unknown " << unknown;
  }
  EXPECT_TRUE(factor.factorise(lower, values.data()));
}

Eigen::MatrixXd solved(DirectFactor& factor, const Matrix& matrix, int threads) {
  const int before = threads_in_use();
  use_threads(threads);
  factor.factorise(matrix);
  use_threads(before);
  return factor.solve(right_sides(matrix.rows(), 1));
}

TEST(SupernodalFactor, DependsOnNoNumberOfThreads) {
  for (const Matrix& matrix : matrices()) {
    const auto factor = make_cholesky();
    const Eigen::MatrixXd by_one = solved(*factor, matrix, 1);
    for (const int threads : {2, 3, 8}) EXPECT_EQ(solved(*factor, matrix, threads), by_one) << threads << " threads";
  }
}

TEST(SupernodalFactor, KeepsNothingOfTheMatrixBefore) {
  const Matrix first = box_of(28, 27, 26, 1), second = box_of(28, 27, 26, 2);
  const auto used = make_cholesky(), fresh = make_cholesky();
  used->factorise(first);
  EXPECT_EQ(solved(*used, second, 2), solved(*fresh, second, 2));
}

TEST(SupernodalFactor, IsSoundForPositiveDefiniteMatricesAlone) {
  for (const Matrix& matrix : matrices()) {
    const auto factor = make_cholesky();
    const auto changed = [&](double diagonal) {
      Matrix other = matrix;
      other.coeffRef(matrix.rows() / 2, matrix.rows() / 2) = diagonal;
      return other;
    };
    for (const double diagonal : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
      factor->factorise(changed(diagonal));
      EXPECT_FALSE(factor->sound()) << matrix.rows() << " unknowns, " << diagonal;
    }
    factor->factorise(matrix);
    EXPECT_TRUE(factor->sound()) << matrix.rows() << " unknowns";
  }
}

}  // namespace
}  // namespace scree::thermal
