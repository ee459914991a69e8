// For vectors of many megabytes: their memory is asked for in huge pages (huge_pages.h). Where the system has to find a page of
// 4 kB for every few elements that are written first, it takes a third of a large contact search.
#pragma once

#include <cstdlib>
#include <memory>
#include <vector>

#include "engine/base/huge_pages.h"

namespace scree {

template <class Item>
struct LargeAllocator : std::allocator<Item> {
  Item* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(Item);
    if (bytes < worth_huge_pages) return std::allocator<Item>::allocate(count);
    return static_cast<Item*>(allocate_pages(bytes, huge_page));
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
