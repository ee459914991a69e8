// Content hashes: what a stage depends on, in 32 hexadecimal digits.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace scree {

// XXH3, 128 bits: fast and well spread, not meant against forgery.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  Hasher& add_bytes(const void* data, std::size_t size);

  // A text with its length, so that "ab" + "c" differs from "a" + "bc".
  Hasher& add(std::string_view text);

  template <class T>
  requires std::is_arithmetic_v<T> Hasher& add(T value) { return add_bytes(&value, sizeof value); }

  [[nodiscard]] std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree
