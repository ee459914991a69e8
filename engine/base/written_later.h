// For vectors that are made at their full length and then written by all threads: resize() leaves new elements as they are, so
// each page of a large one is first touched, and found by the system, by the thread that writes it.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/large_vector.h"

namespace scree {

template <class Item>
struct WrittenLater : LargeAllocator<Item> {
  // Whoever asked for the element assigns to it before it is read.
  template <class Made>
  void construct(Made*) noexcept {
    static_assert(std::is_trivially_destructible_v<Made>);
  }
  template <class Made, class... Arguments>
  void construct(Made* item, Arguments&&... arguments) {
    std::construct_at(item, std::forward<Arguments>(arguments)...);
  }
};

template <class Item>
using VectorWrittenLater = std::vector<Item, WrittenLater<Item>>;

}  // namespace scree
