// Matrices to factorise and right sides to solve for.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include <Eigen/SparseCore>

namespace scree::thermal::test {

using Matrix = Eigen::SparseMatrix<double>;

// Heat conduction between the cells of a box, each with a capacity; conductances differ at random by five orders.
inline Matrix box_of(int x, int y, int z, unsigned seed) {
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
inline Matrix side_by_side(const Matrix& a, const Matrix& b) {
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

inline Eigen::MatrixXd right_sides(Eigen::Index rows, int count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> heat(-1, 1);
  Eigen::MatrixXd rhs(rows, count);
  for (double& value : rhs.reshaped()) value = heat(generator);
  return rhs;
}

inline std::vector<Matrix> matrices() {
  return {box_of(1, 1, 1, 1),    box_of(7, 1, 1, 2),    box_of(9, 8, 1, 3),
          box_of(16, 15, 14, 4), box_of(28, 27, 26, 5), side_by_side(box_of(20, 20, 20, 6), box_of(20, 21, 20, 7))};
}

}  // namespace scree::thermal::test
