// What the chunks of a loop give, a part for each: put together in memory that is taken in large pieces, as many small vectors
// would be copied while they grow and leave half of their memory unused.
#pragma once

#include <algorithm>
#include <mutex>
#include <span>
#include <vector>

#include "engine/base/written_later.h"

namespace scree {

template <class Item>
class Parts {
 public:
  explicit Parts(std::size_t count) : parts_(count) {}

  // Once for each part, from any thread.
  void put(std::size_t part, const std::vector<Item>& items) {
    const std::span<Item> place = take(items.size());
    std::copy(items.begin(), items.end(), place.begin());
    parts_[part] = place;
  }

  // Gives its memory back; all parts are empty then.
  void clear() {
    std::fill(parts_.begin(), parts_.end(), std::span<const Item>());
    pieces_.clear();
    taken_ = used_ = 0;
  }

  [[nodiscard]] auto begin() const { return parts_.begin(); }
  [[nodiscard]] auto end() const { return parts_.end(); }
  [[nodiscard]] std::size_t count() const { return parts_.size(); }
  [[nodiscard]] std::span<const Item> operator[](std::size_t part) const { return parts_[part]; }

 private:
  static constexpr std::size_t large = worth_huge_pages / sizeof(Item) + 1;
  static constexpr std::size_t enough = huge_page / 16 / sizeof(Item);  // to make up for clearing a huge page

  std::span<Item> take(std::size_t count) {
    const std::lock_guard lock(turn_);
    if (pieces_.empty() || pieces_.back().size() - used_ < count) {
      pieces_.emplace_back(taken_ < enough ? count : std::max(large, count));
      taken_ += pieces_.back().size();
      used_ = 0;
    }
    const std::span<Item> place(pieces_.back().data() + used_, count);
    used_ += count;
    return place;
  }

  std::vector<std::span<const Item>> parts_;
  std::mutex turn_;
  std::vector<VectorWrittenLater<Item>> pieces_;
  std::size_t taken_ = 0;  // by all pieces
  std::size_t used_ = 0;   // of the last piece
};

}  // namespace scree
