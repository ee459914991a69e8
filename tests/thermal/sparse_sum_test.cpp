#include "thermal/sparse_sum.h"

#include <random>

#include <gtest/gtest.h>

namespace scree::thermal {
namespace {

SparseMatrix random_matrix(int size, int entries, unsigned seed) {
  std::mt19937 generator(seed);
  const auto index = [&] { return static_cast<int>(generator() % static_cast<unsigned>(size)); };
  std::vector<Eigen::Triplet<double>> list;
  for (int i = 0; i < entries; ++i) list.emplace_back(index(), index(), 1.0 + static_cast<double>(generator() % 1000));
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(list.begin(), list.end());
  return matrix;
}

TEST(SparseSum, HasTheEntriesOfBothToTheBit) {
  for (const int size : {1, 7, 10'000}) {
    const SparseMatrix a = random_matrix(size, 3 * size, 1), b = random_matrix(size, 4 * size, 2);
    const SparseMatrix sum = sum_of(a, b), expected = a + b;
    ASSERT_EQ(sum.nonZeros(), expected.nonZeros());
    EXPECT_TRUE(sum.isCompressed());
    EXPECT_EQ(SparseMatrix(sum - expected).norm(), 0);
  }
}

TEST(SparseSum, OfNothingIsTheOther) {
  const SparseMatrix a = random_matrix(50, 200, 3);
  EXPECT_EQ(SparseMatrix(sum_of(a, SparseMatrix(50, 50)) - a).norm(), 0);
  EXPECT_EQ(SparseMatrix(sum_of(SparseMatrix(50, 50), a) - a).norm(), 0);
}

}  // namespace
}  // namespace scree::thermal
