#include "engine/base/heap_pages.h"

#include <cstdint>
#include <cstdlib>

#include <malloc.h>
#include <unistd.h>

#include "engine/base/huge_pages.h"

namespace scree {

namespace {

constexpr int reserved = 32 * huge_page;     // as much as small and middling runs use [bytes]
constexpr int grown_by = huge_page / 2;      // beyond that, at a time
constexpr int kept = 2 * reserved;           // free memory at the heap's end that does not go back to the system
constexpr int least_growth = huge_page / 2;  // more than is free in a heap that has just begun, so that it grows

}  // namespace

void keep_heap_in_huge_pages() {
  // Given, or glibc goes by the first large arrays that happen to be freed.
  mallopt(M_MMAP_THRESHOLD, worth_huge_pages);
  mallopt(M_TRIM_THRESHOLD, kept);
  mallopt(M_TOP_PAD, reserved);
  mallopt(M_ARENA_MAX, 1);  // the same heap for all threads, who allocate little while they compute
  auto* const end = static_cast<char*>(sbrk(0));
  void* volatile grows = std::malloc(least_growth);
  const auto next = reinterpret_cast<std::uintptr_t>(grows);
  std::free(grows);
  mallopt(M_TOP_PAD, grown_by);
  const std::intptr_t more = static_cast<char*>(sbrk(0)) - end;
  if (more < reserved) return;
  prefer_huge_pages(end, static_cast<std::size_t>(more));
  // A page that holds anything yet stays as small as it is. What lies before the first huge one that holds nothing is left out.
  const std::uintptr_t first = (next + least_growth + huge_page) / huge_page * huge_page;
  [[maybe_unused]] static void* volatile unused = nullptr;
  unused = std::malloc(first - next);
}

}  // namespace scree
