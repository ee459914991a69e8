#include "engine/base/parts.h"

#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace scree {
namespace {

// Of all sizes, together more than a large piece holds.
std::vector<int> items_of(std::size_t part) {
  std::vector<int> items(part % 3 == 0 ? part : 10'000 * part);
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = static_cast<int>(1'000'000 * part + i);
  return items;
}

bool holds(std::span<const int> part, const std::vector<int>& items) {
  return std::equal(part.begin(), part.end(), items.begin(), items.end());
}

TEST(Parts, HoldWhatWasPutIntoThemFromAnyThread) {
  constexpr std::size_t count = 60;
  Parts<int> parts(count);
  const auto put_every_second = [&](std::size_t first) {
    for (std::size_t part = first; part < count; part += 2) parts.put(part, items_of(part));
  };
  std::thread other(put_every_second, 1);
  put_every_second(0);
  other.join();
  for (std::size_t part = 0; part < count; ++part) EXPECT_TRUE(holds(parts[part], items_of(part))) << part;
}

TEST(Parts, AreEmptyUntilTheyArePut) {
  const Parts<int> parts(2);
  EXPECT_EQ(parts.count(), 2u);
  EXPECT_TRUE(parts[1].empty());
}

TEST(Parts, AreEmptyAgainOnceCleared) {
  Parts<int> parts(3);
  parts.put(2, items_of(40));
  parts.clear();
  for (const auto& part : parts) EXPECT_TRUE(part.empty());
  parts.put(1, items_of(5));
  EXPECT_TRUE(holds(parts[1], items_of(5)));
}

TEST(LargeVector, BeginsWithAHugePageWhereItFillsSome) {
  LargeVector<double> values(worth_huge_pages / sizeof(double), 1.5);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % huge_page, 0u);
  values.push_back(2.5);
  EXPECT_EQ(values.front(), 1.5);
  EXPECT_EQ(values.back(), 2.5);
  values.resize(3);
  values.shrink_to_fit();
  EXPECT_EQ(values, LargeVector<double>(3, 1.5));
}

}  // namespace
}  // namespace scree
