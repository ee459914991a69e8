#include "engine/base/page_buffer.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "engine/base/huge_pages.h"

namespace scree {

void PageBuffer::Free::operator()(char* bytes) const {
  std::free(bytes);
}

char* PageBuffer::room(std::size_t count) {
  if (size_ + count > capacity_) {
    const std::size_t wanted = std::max(size_ + count, 2 * capacity_);
    // Every write looks up the pages, whose number is then hundreds of times less.
    const std::size_t unit = wanted > huge_page / 2 ? huge_page : page;
    const std::size_t capacity = (wanted + unit - 1) / unit * unit;
    std::unique_ptr<char, Free> larger(static_cast<char*>(allocate_pages(capacity, unit)));
    if (size_ > 0) std::memcpy(larger.get(), bytes_.get(), size_);
    bytes_ = std::move(larger);
    capacity_ = capacity;
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
