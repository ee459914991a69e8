#include "engine/base/heap_pages.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "engine/base/huge_pages.h"

namespace scree {

namespace {

constexpr int reserved = 32 * huge_page;     // as much as small and middling runs use [bytes]
constexpr int grown_by = 8 * huge_page;      // beyond that, at a time
constexpr int kept = 2 * reserved;           // free memory at the heap's end that does not go back to the system
constexpr int least_growth = huge_page / 2;  // more than is free in a heap that has just begun, so that it grows

std::atomic<char*> asked_until = nullptr;  // the end of the heap that is to be in huge pages; nothing if it is not

// The system forgets for what lies behind the end of the heap what it was asked for before it.
void ask_for_growth() {
  auto* const end = static_cast<char*>(sbrk(0));
  char* const begin = asked_until.exchange(end, std::memory_order_relaxed);
  if (end > begin) madvise(begin, static_cast<std::size_t>(end - begin), MADV_HUGEPAGE);
}

void* allocated(std::size_t bytes) {
  char* const until = asked_until.load(std::memory_order_relaxed);
  if (until == nullptr) return std::malloc(bytes);
  if (bytes >= worth_huge_pages) return allocate_pages(bytes, huge_page);
  auto* const place = static_cast<char*>(std::malloc(bytes));
  if (place + bytes > until) ask_for_growth();
  return place;
}

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
  asked_until = static_cast<char*>(sbrk(0));
}

}  // namespace scree

// What takes the place of the standard library's: the same, but that large arrays are asked for in huge pages, whoever makes
// them, and what the heap grows by.
void* operator new(std::size_t bytes) {
  if (void* const place = scree::allocated(bytes)) return place;
  throw std::bad_alloc();
}

void operator delete(void* place) noexcept {
  std::free(place);
}

void operator delete(void* place, std::size_t) noexcept {
  std::free(place);
}
