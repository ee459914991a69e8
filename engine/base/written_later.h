// For vectors that are made at their full length and then written by all threads: resize() leaves new elements as they are, so
// each page of a large one is first touched, and found by the system, by the thread that writes it.
#pragma once

#include <memory>
#include <type_traits>
#include <vector>

namespace scree {

template <class Item>
struct WrittenLater : std::allocator<Item> {
  // Whoever asked for the element assigns to it before it is read.
  template <class Made>
  void construct(Made*) noexcept {
    static_assert(std::is_trivially_copyable_v<Made> && std::is_aggregate_v<Made>);
  }
};

template <class Item>
using VectorWrittenLater = std::vector<Item, WrittenLater<Item>>;

}  // namespace scree
