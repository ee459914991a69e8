#include "engine/base/huge_pages.h"

#include <cstdint>

#include <sys/mman.h>

namespace scree {

namespace {

constexpr std::uintptr_t huge = 1 << 21;
constexpr std::size_t worth_it = 4 * huge;

}  // namespace

void prefer_huge_pages(void* data, std::size_t bytes) {
  if (bytes < worth_it) return;
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t begin = (address + huge - 1) / huge * huge;
  const std::uintptr_t end = (address + bytes) / huge * huge;
  madvise(static_cast<char*>(data) + (begin - address), end - begin, MADV_HUGEPAGE);
}

}  // namespace scree
