#include "engine/base/heap_pages.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "engine/base/huge_pages.h"
#include "engine/base/kept_blocks.h"

namespace scree {

namespace {

constexpr int reserved = 32 * huge_page;     // as much as small and middling runs use [bytes]
constexpr int grown_by = 8 * huge_page;      // beyond that, at a time
constexpr int kept = 2 * reserved;           // free memory at the heap's end that does not go back to the system
constexpr int least_growth = huge_page / 2;  // more than is free in a heap that has just begun, so that it grows

std::uintptr_t end_of_heap() {
  return reinterpret_cast<std::uintptr_t>(sbrk(0));
}

// The end of the heap that has been asked for in huge pages; without end as long as it is not to be.
constinit std::atomic<std::uintptr_t> asked_until = UINTPTR_MAX;

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
  asked_until = end_of_heap();
}

}  // namespace scree

// A sanitizer has a malloc() of its own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// What the C library's own functions are called beside their usual names, for programs that replace those.
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" {
void* __libc_malloc(std::size_t bytes);
void* __libc_memalign(std::size_t alignment, std::size_t bytes);
void* __libc_realloc(void* place, std::size_t bytes);
void __libc_free(void* place);
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)

namespace scree {

namespace {

// The system forgets for what lies behind the end of the heap what it was asked for before it. Not in whole huge pages, so that
// one may lie where the heap ended.
void ask_for_growth() {
  const std::uintptr_t end = end_of_heap();
  const std::uintptr_t begin = asked_until.exchange(end, std::memory_order_relaxed);
  if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

struct HugePages {
  static void* make(std::size_t bytes) {
    void* const block = __libc_memalign(huge_page, bytes);
    if (block != nullptr) madvise(block, bytes, MADV_HUGEPAGE);
    return block;
  }
  static void give_back(void* block) { __libc_free(block); }
};

constinit KeptBlocks<HugePages> large_blocks;

bool is_large(std::size_t bytes) {
  return bytes >= worth_huge_pages && bytes < PTRDIFF_MAX / 2;  // what is larger is not to be had
}

// How long a block is, if it is one of those; else 0.
std::ptrdiff_t size_of_large(void* place) {
  if (reinterpret_cast<std::uintptr_t>(place) % huge_page != 0) return 0;
  const std::size_t bytes = malloc_usable_size(place) / huge_page * huge_page;
  return bytes < worth_huge_pages ? 0 : static_cast<std::ptrdiff_t>(bytes);
}

}  // namespace

}  // namespace scree

// The C library's, but that large arrays come in huge pages, whoever makes them, and that what the heap grows by is asked for
// so.
extern "C" {

void* malloc(std::size_t bytes) {
  if (scree::is_large(bytes)) return scree::large_blocks.take(bytes);
  void* const place = __libc_malloc(bytes);
  const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(place) + bytes;
  if (end > scree::asked_until.load(std::memory_order_relaxed)) scree::ask_for_growth();
  return place;
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  const bool large = scree::is_large(bytes) && alignment <= scree::huge_page;
  return large ? scree::large_blocks.take(bytes) : __libc_memalign(alignment, bytes);
}

// Large arrays are lengthened by moving their pages, which the C library does.
void* realloc(void* place, std::size_t bytes) {
  const std::ptrdiff_t before = scree::size_of_large(place);
  if (before == 0 && scree::is_large(bytes)) {
    void* const moved = malloc(bytes);
    if (moved == nullptr) return nullptr;
    if (place != nullptr) std::memcpy(moved, place, std::min(bytes, malloc_usable_size(place)));
    free(place);
    return moved;
  }
  void* const moved = __libc_realloc(place, bytes);
  if (before > 0 && (moved != nullptr || bytes == 0)) scree::large_blocks.count(scree::size_of_large(moved) - before);
  return moved;
}

void free(void* place) {
  const std::ptrdiff_t size = scree::size_of_large(place);
  size > 0 ? scree::large_blocks.keep(place, size) : __libc_free(place);
}

}  // extern "C"

#endif
