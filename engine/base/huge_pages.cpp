#include "engine/base/huge_pages.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace scree {

namespace {

void ask_for_huge_pages(void* data, std::size_t bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t begin = (address + huge_page - 1) / huge_page * huge_page;
  const std::uintptr_t end = (address + bytes) / huge_page * huge_page;
  if (begin < end) madvise(static_cast<char*>(data) + (begin - address), end - begin, MADV_HUGEPAGE);
}

}  // namespace

void prefer_huge_pages(void* data, std::size_t bytes) {
  if (bytes >= worth_huge_pages) ask_for_huge_pages(data, bytes);
}

void* allocate_pages(std::size_t bytes, std::size_t page) {
  void* const memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
  if (memory == nullptr) throw std::bad_alloc();
  if (page == huge_page) ask_for_huge_pages(memory, bytes);
  return memory;
}

}  // namespace scree
