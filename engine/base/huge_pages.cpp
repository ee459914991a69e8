#include "engine/base/huge_pages.h"

#include <cstdint>

#include <sys/mman.h>

namespace scree {

void prefer_huge_pages(void* data, std::size_t bytes, std::size_t worth) {
  if (bytes < worth) return;
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t begin = (address + huge_page - 1) / huge_page * huge_page;
  const std::uintptr_t end = (address + bytes) / huge_page * huge_page;
  madvise(static_cast<char*>(data) + (begin - address), end - begin, MADV_HUGEPAGE);
}

}  // namespace scree
