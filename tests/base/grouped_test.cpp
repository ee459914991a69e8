#include "engine/base/grouped.h"

#include <random>

#include <gtest/gtest.h>

#include "engine/base/threads.h"

namespace scree {
namespace {

// A group and a value.
using Item = std::pair<std::uint32_t, int>;
using SomeParts = std::vector<std::vector<Item>>;

// In no order, or so that the groups of a part are near each other.
SomeParts random_parts(std::size_t count, std::uint32_t groups, bool in_order) {
  std::mt19937 random(7);
  SomeParts parts(count);
  int value = 0;
  for (std::size_t part = 0; part < count; ++part) {
    parts[part].resize(random() % 300);
    for (auto& item : parts[part]) {
      const std::size_t any = random() % groups,
                        near = std::min<std::size_t>(part * groups / count + random() % 50, groups - 1);
      item = {static_cast<std::uint32_t>(in_order ? near : any), ++value};
    }
  }
  return parts;
}

Grouped<int, std::uint32_t> group(const SomeParts& parts, std::size_t groups) {
  return grouped<int, std::uint32_t>(parts.size(), groups, [&](std::size_t part, const auto& visit) {
    for (const auto& [group, value] : parts[part]) visit(group, value);
  });
}

// By sorting, which leaves the values of a group as they came.
void expect_in_order(const Grouped<int, std::uint32_t>& found, const SomeParts& parts, std::size_t groups) {
  std::vector<Item> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::stable_sort(all.begin(), all.end(), [](const Item& a, const Item& b) { return a.first < b.first; });
  ASSERT_EQ(found.begin.size(), groups + 1);
  ASSERT_EQ(found.values.size(), all.size());
  for (std::size_t g = 0; g < groups; ++g) {
    for (std::uint32_t i = found.begin[g]; i < found.begin[g + 1]; ++i) EXPECT_EQ(Item(g, found.values[i]), all[i]);
  }
  EXPECT_EQ(found.begin[groups], all.size());
}

TEST(Grouped, AreInTheOrderOfTheirPartsForAnyNumberOfThreads) {
  const int before = threads_in_use();
  for (const int threads : {1, 2, 3, 8}) {
    use_threads(threads);
    for (const bool in_order : {false, true}) {
      for (const std::uint32_t groups : {1u, 5u, 1000u}) {
        const SomeParts parts = random_parts(100, groups, in_order);
        expect_in_order(group(parts, groups), parts, groups);
      }
    }
  }
  use_threads(before);
}

TEST(Grouped, OfNothingAreNone) {
  const auto none = group({}, 3);
  EXPECT_EQ(std::vector<std::uint32_t>(none.begin.begin(), none.begin.end()), (std::vector<std::uint32_t>{0, 0, 0, 0}));
  EXPECT_TRUE(none.values.empty());
  EXPECT_EQ(group(SomeParts(2), 0).begin.size(), 1u);
}

}  // namespace
}  // namespace scree
