// How a forest of supernodes is cut: nothing is lost or done twice, no tree needs another, and two threads have as much to do.
#include "thermal/supernode_forest.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace scree::thermal {
namespace {

// Supernodes of one column each, of which each but the last few has one row below: its parent's.
class Forest {
 public:
  explicit Forest(const std::vector<int>& parents) : parents_(parents), first_(parents.size() + 1), rows_begin_{0} {
    std::iota(first_.begin(), first_.end(), 0);
    for (std::size_t s = 0; s < parents.size(); ++s) {
      rows_.push_back(static_cast<int>(s));
      if (parents[s] >= 0) rows_.push_back(parents[s]);
      rows_begin_.push_back(static_cast<int>(rows_.size()));
    }
  }
  [[nodiscard]] SupernodalPattern pattern() const {
    const auto count = static_cast<int>(parents_.size());
    return {count, count, first_.data(), rows_begin_.data(), rows_.data(), nullptr, nullptr};
  }
  [[nodiscard]] int parent(int s) const { return parents_[s]; }

 private:
  std::vector<int> parents_, first_, rows_begin_, rows_;
};

std::int64_t heavier_half(const CutForest& forest) {
  const auto middle = forest.trees.begin() + static_cast<std::ptrdiff_t>(forest.trees.size() / 2);
  const auto add = [](std::int64_t sum, const CutForest::Tree& tree) { return sum + tree.weight; };
  return std::max(std::accumulate(forest.trees.begin(), middle, std::int64_t{0}, add),
                  std::accumulate(middle, forest.trees.end(), std::int64_t{0}, add));
}

TEST(SupernodeForest, TreesOfUnlikeWeightsBelowOneRootAreDealtOutEvenlyToTwoThreads) {
  const Forest forest({5, 5, 5, 5, 5, -1});
  const CutForest cut = cut_forest(forest.pattern(), {17, 13, 12, 7, 6, 30}, 4, 1);
  EXPECT_EQ(cut.top, std::vector<int>{5});
  EXPECT_EQ(cut.trees.size(), 4U);
  EXPECT_LE(heavier_half(cut), 29);
}

TEST(SupernodeForest, WhatASecondThreadIsNotWorthWakingUpForStaysTogether) {
  const Forest forest({2, 2, -1, 5, 5, -1});
  const CutForest cut = cut_forest(forest.pattern(), {3, 3, 3, 3, 3, 3}, 4, 20);
  ASSERT_EQ(cut.trees.size(), 1U);
  EXPECT_EQ(cut.trees.front().supernodes, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(cut.top.empty());
}

TEST(SupernodeForest, EachSupernodeIsDoneOnceAfterThoseBelowItInNoOtherTreeThanTheirs) {
  std::mt19937 generator(3);
  for (int round = 0; round < 50; ++round) {
    const int count = 1 + static_cast<int>(generator() % 300);
    std::vector<int> parents(count, -1);
    std::vector<std::int64_t> weights(count);
    for (int s = 0; s < count; ++s) {
      if (s + 1 < count && generator() % 20 > 0) parents[s] = s + 1 + static_cast<int>(generator() % 9) % (count - s - 1);
      weights[s] = 1 + generator() % 100;
    }
    const Forest forest(parents);
    const CutForest cut = cut_forest(forest.pattern(), weights, 5, 10);
    std::vector<int> place(count, -2);
    for (const int s : cut.top) place[s] = -1;
    int number = 0;
    for (const CutForest::Tree& tree : cut.trees) {
      EXPECT_TRUE(std::is_sorted(tree.supernodes.begin(), tree.supernodes.end()));
      for (const int s : tree.supernodes) {
        EXPECT_EQ(place[s], -2) << "twice";
        place[s] = number;
      }
      ++number;
    }
    for (int s = 0; s < count; ++s) {
      ASSERT_NE(place[s], -2) << "left out";
      if (parents[s] >= 0) {
        EXPECT_TRUE(place[parents[s]] == -1 || place[parents[s]] == place[s]);
      }
    }
  }
}

}  // namespace
}  // namespace scree::thermal
