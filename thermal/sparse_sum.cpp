#include "thermal/sparse_sum.h"

#include <numeric>

#include "engine/base/huge_pages.h"
#include "engine/base/threads.h"

namespace scree::thermal {

namespace {

// Calls entry(row, value) for the entries of the sum in one column, ascending.
template <class Entry>
void merge(const SparseMatrix& a, const SparseMatrix& b, Eigen::Index column, const Entry& entry) {
  SparseMatrix::InnerIterator left(a, column), right(b, column);
  while (left || right) {
    if (!right || (left && left.row() < right.row())) {
      entry(left.row(), left.value());
      ++left;
    } else if (!left || right.row() < left.row()) {
      entry(right.row(), right.value());
      ++right;
    } else {
      entry(left.row(), left.value() + right.value());
      ++left;
      ++right;
    }
  }
}

}  // namespace

SparseMatrix uninitialised(Eigen::Index size, Eigen::Index entries) {
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(entries);
  const auto count = static_cast<std::size_t>(entries);
  prefer_huge_pages(matrix.valuePtr(), count * sizeof(double));
  prefer_huge_pages(matrix.innerIndexPtr(), count * sizeof(int));
  return matrix;
}

SparseMatrix sum_of(const SparseMatrix& a, const SparseMatrix& b) {
  std::vector<int> end(static_cast<std::size_t>(a.cols()) + 1, 0);
#pragma omp parallel for schedule(static) if (a.cols() >= rows_worth_sharing)
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    merge(a, b, column, [&](Eigen::Index, double) { ++end[column + 1]; });
  }
  std::partial_sum(end.begin(), end.end(), end.begin());
  SparseMatrix sum = uninitialised(a.cols(), end.back());
  std::copy(end.begin(), end.end(), sum.outerIndexPtr());
#pragma omp parallel for schedule(static) if (a.cols() >= rows_worth_sharing)
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    int at = end[column];
    merge(a, b, column, [&](Eigen::Index row, double value) {
      sum.innerIndexPtr()[at] = static_cast<int>(row);
      sum.valuePtr()[at++] = value;
    });
  }
  return sum;
}

}  // namespace scree::thermal
