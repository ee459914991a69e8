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

TEST(HeapPages, AreAskedToBeHugeForWhatARunTakesInSmallPieces) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "a system without huge pages";
  keep_heap_in_huge_pages();
  std::vector<std::unique_ptr<std::vector<char>>> pieces;
  int huge = 0;
  for (int i = 0; i < 1000; ++i) {
    pieces.push_back(std::make_unique<std::vector<char>>(30'000));
    huge += flags_at(pieces.back()->data()).find(" hg ") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(huge, 900);  // the first of 30 MB lie where the heap had begun
}

}  // namespace
}  // namespace scree
