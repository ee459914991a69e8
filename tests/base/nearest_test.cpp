#include "engine/base/nearest.h"

#include <gmock/gmock.h>

namespace scree {

namespace {

TEST(Nearest, DistanceCountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("desnity", "density"), 1u);
  EXPECT_EQ(edit_distance("density", "density"), 0u);
  EXPECT_EQ(edit_distance("ab", "ba"), 1u);
}

TEST(Nearest, DistanceIsSymmetric) {
  const std::vector<std::string> words{"", "a", "ore", "rock", "density", "conductivity", "conduct"};
  for (const auto& a : words) {
    for (const auto& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
  }
}

TEST(Nearest, FarWordsAreNotSuggested) {
  const std::vector<std::string> names{"density", "friction"};
  EXPECT_EQ(nearest("desnity", names), "density");
  EXPECT_EQ(nearest("frction", names), "friction");
  EXPECT_EQ(nearest("colour", names), std::nullopt);
  EXPECT_EQ(nearest("x", {"a", "b"}), std::nullopt);
  EXPECT_EQ(suggest("colour", names), "Known: density, friction");
  EXPECT_EQ(nearest(std::string(100000, 'a'), names), std::nullopt);
}

}  // namespace

}  // namespace scree
