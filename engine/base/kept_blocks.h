// Large blocks of memory that are kept when they are freed, for those that are asked for next.
//
// What the system gives it has to clear first, and on a virtual machine its host may have to find it: for what each step of a
// large run makes and frees again that takes as long as the step itself. Kept is at most a quarter of what is in use, and never
// so much that large blocks in all are more than at some time before. What else a program uses comes on top: 2 to 8 % of the
// peak of runs of millions of tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>

#include "engine/base/huge_pages.h"

namespace scree {

// System::make(bytes) gives a block, or nothing if there is no memory; System::give_back(block) takes one. For any threads.
// Needs no memory of its own and nothing done at the start, as it is what memory comes from.
template <class System>
class KeptBlocks {
 public:
  // A block with room for so many bytes; nothing if there is no memory.
  void* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const std::ptrdiff_t size = whole(bytes);
    void* block = kept_one(size);
    if (block == nullptr) block = made(size);
    return block;
  }

  // One that is used no more, and how long it is: whole huge pages. Gives it back if there is no room for it.
  void keep(void* block, std::ptrdiff_t size) {
    const std::lock_guard lock(mutex_);
    used_ -= size;
    while (count_ > 0 && (count_ == blocks_.size() || kept_ + size > used_ / part_kept)) give_back_first();
    if (kept_ + size > used_ / part_kept) return System::give_back(block);
    blocks_[count_++] = {block, size};
    kept_ += size;
  }

  // What is in use has changed by so much in another way.
  void count(std::ptrdiff_t size) {
    const std::lock_guard lock(mutex_);
    used_ += size;
  }

 private:
  static constexpr std::ptrdiff_t part_kept = 4;   // one in so many
  static constexpr std::ptrdiff_t part_spare = 8;  // how much longer a block may be than what is asked for: one in so many

  struct Block {
    void* place;
    std::ptrdiff_t size;
  };

  // In whole huge pages.
  static constexpr std::ptrdiff_t whole(std::size_t bytes) {
    return static_cast<std::ptrdiff_t>((bytes + huge_page - 1) / huge_page * huge_page);
  }

  // The shortest that fits.
  void* kept_one(std::ptrdiff_t size) {
    const auto end = blocks_.begin() + count_;
    auto best = end;
    for (auto block = blocks_.begin(); block != end; ++block) {
      if (block->size < size || block->size - size > size / part_spare) continue;
      if (best == end || block->size < best->size) best = block;
    }
    if (best == end) return nullptr;
    void* const place = best->place;
    used_ += best->size;
    remove(best);
    return place;
  }

  void* made(std::ptrdiff_t size) {
    while (count_ > 0 && used_ + kept_ + size > peak_) give_back_first();
    void* block = System::make(static_cast<std::size_t>(size));
    while (block == nullptr && count_ > 0) {
      give_back_first();
      block = System::make(static_cast<std::size_t>(size));
    }
    if (block == nullptr) return nullptr;
    used_ += size;
    peak_ = std::max(peak_, used_ + kept_);
    return block;
  }

  // The one that has been kept longest.
  void give_back_first() {
    System::give_back(blocks_.front().place);
    remove(blocks_.begin());
  }

  void remove(Block* block) {
    kept_ -= block->size;
    std::copy(block + 1, blocks_.begin() + count_, block);
    --count_;
  }

  std::mutex mutex_;
  std::array<Block, 64> blocks_{};  // kept ones, as they were freed
  std::size_t count_ = 0;
  std::ptrdiff_t used_ = 0, kept_ = 0;  // [bytes]
  std::ptrdiff_t peak_ = 0;             // of both together [bytes]
};

}  // namespace scree
