#include "engine/rigid/row_batches.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace scree::rigid {
namespace {

std::vector<Eigen::Vector3d> cloud(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Eigen::Vector3d> centres;
  for (int i = 0; i < count; ++i) centres.emplace_back(0.3 * place(random), 2 * place(random), place(random));
  return centres;
}

TEST(Slabs, HoldAsManyBodiesEachAlongTheLongestAxis) {
  const auto centres = cloud(4000);
  const std::vector<int> slabs = slabs_of(centres, 8);
  std::vector<int> counts(8, 0);
  std::vector<double> highest(8, -9);
  std::vector<double> lowest(8, 9);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    ++counts[slabs[i]];
    highest[slabs[i]] = std::max(highest[slabs[i]], centres[i].y());
    lowest[slabs[i]] = std::min(lowest[slabs[i]], centres[i].y());
  }
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(counts[i], 500, 50) << i;
  for (int i = 1; i < 8; ++i) EXPECT_LE(highest[i - 1], lowest[i]) << i;
}

TEST(Batches, DoneAtOnceShareNoBody) {
  const auto centres = cloud(600);
  constexpr int count = 8;
  const std::vector<int> slabs = slabs_of(centres, count);
  std::vector<std::set<std::size_t>> bodies(count + 1);
  std::vector<int> contacts(count + 1, 0);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((centres[i] - centres[j]).norm() > 0.3) continue;
      const int batch = batch_of(slabs[i], slabs[j], count);
      bodies[batch].insert({i, j});
      ++contacts[batch];
    }
  }
  for (int a = 0; a < count; ++a) {
    EXPECT_GT(contacts[a], 100);
    for (int b = a + 2; b < count; b += 2) {
      for (const std::size_t body : bodies[a]) EXPECT_FALSE(bodies[b].contains(body)) << a << ' ' << b;
    }
  }
}

TEST(Batches, OfAFixedBodyAreThoseOfTheOther) {
  EXPECT_EQ(batch_of(-1, 3, 8), 3);
  EXPECT_EQ(batch_of(5, -1, 8), 5);
  EXPECT_EQ(batch_of(5, 4, 8), 4);
  EXPECT_EQ(batch_of(1, 7, 8), 8);
}

}  // namespace
}  // namespace scree::rigid
