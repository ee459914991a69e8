// For vectors of many megabytes: their memory is asked for in huge pages (huge_pages.h). Where the system has to find a page of
// 4 kB for every few elements that are written first, it takes a third of a large contact search.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "engine/base/huge_pages.h"

namespace scree {

template <class Item>
struct LargeAllocator : std::allocator<Item> {
  template <class Other>
  struct rebind {
    using other = LargeAllocator<Other>;
  };

  LargeAllocator() = default;
  template <class Other>
  explicit LargeAllocator(const LargeAllocator<Other>&) noexcept {}

  Item* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(Item);
    if (bytes < worth_huge_pages) return std::allocator<Item>::allocate(count);
    void* const memory = std::aligned_alloc(huge_page, (bytes + huge_page - 1) / huge_page * huge_page);
    if (memory == nullptr) throw std::bad_alloc();
    prefer_huge_pages(memory, bytes);
    return static_cast<Item*>(memory);
  }

  void deallocate(Item* items, std::size_t count) {
    if (count * sizeof(Item) < worth_huge_pages) {
      std::allocator<Item>::deallocate(items, count);
    } else {
      std::free(items);
    }
  }
};

template <class Item>
using LargeVector = std::vector<Item, LargeAllocator<Item>>;

}  // namespace scree
