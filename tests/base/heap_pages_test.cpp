#include "engine/base/heap_pages.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
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

class HeapPages : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "a system without huge pages";
    static const bool once = (keep_heap_in_huge_pages(), true);
    (void)once;
  }

  static bool asked_to_be_huge(const void* data) { return flags_at(data).find(" hg ") != std::string::npos; }
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

}  // namespace
}  // namespace scree
