#include "engine/base/huge_pages.h"

#include <cstdint>

#include <sys/mman.h>

namespace scree {

namespace {

constexpr std::uintptr_t huge = 1 << 21;
constexpr std::size_t worth_it = 4 * huge;

struct Pages {
  char* begin;
  std::size_t bytes;
};

// Whole ones among these bytes; none if there are too few.
Pages whole_pages(void* data, std::size_t bytes) {
  if (bytes < worth_it) return {nullptr, 0};
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t begin = (address + huge - 1) / huge * huge;
  const std::uintptr_t end = (address + bytes) / huge * huge;
  return {static_cast<char*>(data) + (begin - address), end - begin};
}

}  // namespace

void prefer_huge_pages(void* data, std::size_t bytes) {
  const Pages pages = whole_pages(data, bytes);
  if (pages.bytes > 0) madvise(pages.begin, pages.bytes, MADV_HUGEPAGE);
}

void make_huge_pages(void* data, std::size_t bytes) {
  prefer_huge_pages(data, bytes);
  const Pages pages = whole_pages(data, bytes);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t at = 0; at < pages.bytes; at += huge) madvise(pages.begin + at, huge, MADV_POPULATE_WRITE);
}

}  // namespace scree
