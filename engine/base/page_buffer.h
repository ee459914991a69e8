// Bytes that grow at their end, in whole pages of memory: from there the system can write to the disk without copying.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace scree {

class PageBuffer {
 public:
  static constexpr std::size_t page = 4096;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::string_view view() const { return {bytes_.get(), size_}; }
  char* data() { return bytes_.get(); }

  // Keeps its memory.
  void clear() { size_ = 0; }

  // Where `count` bytes can be put behind the last one; grow() makes those that were put there part of it.
  char* room(std::size_t count);
  void grow(std::size_t count) { size_ += count; }

  void append(std::string_view bytes);

  // With as many of these as make a further `count` bytes end with a page.
  void fill_page(std::size_t count, char filling);

 private:
  struct Free {
    void operator()(char* bytes) const;
  };
  std::unique_ptr<char, Free> bytes_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace scree
