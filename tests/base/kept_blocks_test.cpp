// What is kept of large blocks, against a count of what the system is asked for.
#include "engine/base/kept_blocks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scree {
namespace {

// A system of so much memory, whose blocks are numbers.
struct CountedSystem {
  static inline std::map<void*, std::size_t> given{};
  static inline std::size_t in_all = 0, made = 0, memory = SIZE_MAX;

  static void* make(std::size_t bytes) {
    if (in_all + bytes > memory) return nullptr;
    void* const block = reinterpret_cast<void*>(++made * huge_page);
    given[block] = bytes;
    in_all += bytes;
    return block;
  }
  static void give_back(void* block) {
    in_all -= given.at(block);
    given.erase(block);
  }
};

class KeptBlocksOf : public testing::Test {
 protected:
  KeptBlocksOf() {
    CountedSystem::given.clear();
    CountedSystem::in_all = CountedSystem::made = 0;
    CountedSystem::memory = SIZE_MAX;
  }

  void* take(std::size_t pages) { return blocks_.take(pages * huge_page); }
  void free(void* block) { blocks_.keep(block, static_cast<std::ptrdiff_t>(CountedSystem::given.at(block))); }

 private:
  KeptBlocks<CountedSystem> blocks_;
};

TEST_F(KeptBlocksOf, AreUsedAgainWithoutAskingTheSystem) {
  take(100);
  void* const first = take(10);
  free(first);
  EXPECT_EQ(take(10), first);
  free(first);
  EXPECT_EQ(take(9), first);  // not much longer than it has to be
  EXPECT_EQ(CountedSystem::made, 2u);
  EXPECT_NE(take(10), first);
}

TEST_F(KeptBlocksOf, AreNotWastedOnWhatIsMuchShorter) {
  take(100);
  void* const first = take(10);
  free(first);
  EXPECT_NE(take(5), first);
}

TEST_F(KeptBlocksOf, AreAQuarterOfWhatIsInUseAtMost) {
  take(100);
  std::array<void*, 10> freed{};
  for (void*& block : freed) block = take(10);
  for (void* const block : freed) free(block);
  EXPECT_EQ(CountedSystem::in_all, 120 * huge_page);
  EXPECT_EQ(take(10), freed[8]);  // those that were freed last
  EXPECT_EQ(take(10), freed[9]);
}

TEST_F(KeptBlocksOf, AreGivenBackWhereMemoryIsShort) {
  CountedSystem::memory = 50 * huge_page;
  take(40);
  free(take(10));
  EXPECT_NE(take(8), nullptr);
  EXPECT_EQ(CountedSystem::in_all, 48 * huge_page);
  EXPECT_EQ(take(8), nullptr);
}

TEST_F(KeptBlocksOf, LeaveThePeakAsItIsWithoutThem) {
  std::mt19937 draw(1);
  std::vector<std::pair<void*, std::size_t>> used;
  std::size_t in_use = 0, peak = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (used.empty() || draw() % 100 < 51) {
      const std::size_t pages = 4 + draw() % 50;
      used.emplace_back(take(pages), pages);
      in_use += CountedSystem::given.at(used.back().first);
      peak = std::max(peak, in_use);
    } else {
      std::swap(used[draw() % used.size()], used.back());
      in_use -= CountedSystem::given.at(used.back().first);
      free(used.back().first);
      used.pop_back();
    }
    ASSERT_LE(CountedSystem::in_all, peak);
    ASSERT_LE(CountedSystem::in_all - in_use, in_use / 4 + 60 * huge_page);
  }
  EXPECT_LT(CountedSystem::made, 5'000u);
}

}  // namespace
}  // namespace scree
