#include "engine/base/heap_pages.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace scree {
namespace {

// The flags of the mapping that holds an address, as the system lists them.
std::string flags_at(const void* data) {
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  std::ifstream maps("/proc/self/smaps");
  bool holds = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-') holds = begin <= address && address < end;
    if (holds && line.starts_with("VmFlags:")) return line + " ";
  }
  return "";
}

// As a program does it: before main().
[[maybe_unused]] const bool begun = (keep_heap_in_huge_pages(), true);

class HeapPages : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer has a malloc() of its own";
#endif
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "a system without huge pages";
  }

  static bool asked_to_be_huge(const void* data) {
    return flags_at(data).find(" hg ") != std::string::npos;
  }
};

// More than the heap begins with: so what it grows by is asked for as well.
TEST_F(HeapPages, AreAskedToBeHugeForWhatARunTakesInSmallPieces) {
  std::vector<std::unique_ptr<std::vector<char>>> pieces;
  int huge = 0;
  for (int i = 0; i < 1000; ++i) {
    pieces.push_back(std::make_unique<std::vector<char>>(200'000));
    huge += asked_to_be_huge(pieces.back()->data()) ? 1 : 0;
  }
  EXPECT_GT(huge, 950);  // the first lie where the heap had begun
}

TEST_F(HeapPages, AreAskedToBeHugeForLargeArraysOutsideTheHeap) {
  const std::vector<double> array(2'000'000);
  EXPECT_TRUE(asked_to_be_huge(array.data() + 1'000'000));
}

TEST_F(HeapPages, HoldWhatWasInAnArrayThatGrowsAndShrinks) {
  constexpr std::size_t mega = 1'000'000;
  auto* array = static_cast<char*>(std::malloc(1));
  array[0] = 1;
  std::size_t before = 1;
  for (const std::size_t bytes : {mega, 20 * mega, 50 * mega, 30 * mega, 9 * mega, mega, 12 * mega}) {
    array = static_cast<char*>(std::realloc(array, bytes));
    ASSERT_NE(array, nullptr);
    for (std::size_t i = 0; i < std::min(before, bytes); i += 999) ASSERT_EQ(array[i], static_cast<char>(i % 100 + 1));
    for (std::size_t i = 0; i < bytes; i += 999) array[i] = static_cast<char>(i % 100 + 1);
    before = bytes;
  }
  std::free(array);
}

TEST_F(HeapPages, AreRefusedWhereThereIsNoSuchMemory) {
  const volatile std::size_t too_many = SIZE_MAX - 100;
  EXPECT_EQ(std::malloc(too_many), nullptr);
}

// What one thread frees another may use next, and each finds in its own only what it wrote.
TEST_F(HeapPages, AreSharedByThreads) {
  std::atomic<int> wrong = 0;
  const auto work = [&wrong](int own) {
    std::mt19937 draw(own);
    for (int i = 0; i < 200; ++i) {
      const std::vector<int> array((2 + draw() % 4) * 1'000'000, own);
      wrong += array.front() == own && array.back() == own ? 0 : 1;
    }
  };
  std::thread other(work, 2);
  work(1);
  other.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace scree
