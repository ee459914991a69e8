#include "engine/base/page_buffer.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

namespace scree {

void PageBuffer::Free::operator()(char* bytes) const {
  std::free(bytes);
}

char* PageBuffer::room(std::size_t count) {
  if (size_ + count > capacity_) {
    const std::size_t pages = std::max((size_ + count + page - 1) / page, 2 * capacity_ / page);
    std::unique_ptr<char, Free> larger(static_cast<char*>(std::aligned_alloc(page, pages * page)));
    if (!larger) throw std::bad_alloc();
    if (size_ > 0) std::memcpy(larger.get(), bytes_.get(), size_);
    bytes_ = std::move(larger);
    capacity_ = pages * page;
  }
  return bytes_.get() + size_;
}

void PageBuffer::append(std::string_view bytes) {
  std::copy(bytes.begin(), bytes.end(), room(bytes.size()));
  grow(bytes.size());
}

void PageBuffer::fill_page(std::size_t count, char filling) {
  const std::size_t missing = (page - (size_ + count) % page) % page;
  std::fill_n(room(missing), missing, filling);
  grow(missing);
}

}  // namespace scree
