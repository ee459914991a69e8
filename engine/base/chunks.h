// Loops over many small pieces of work on all threads, a chunk of consecutive indices at a time. Where the chunks end does not
// depend on the number of threads, so what is collected chunk by chunk comes in the same order for any.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace scree {

struct Chunk {
  std::size_t number;  // counted from 0
  std::size_t begin;
  std::size_t end;
};

inline constexpr std::size_t chunk_size = 512;

constexpr std::size_t chunk_count(std::size_t count) {
  return (count + chunk_size - 1) / chunk_size;
}

// Calls body(Chunk) for every chunk of [0, count), in no order of note. The body must not throw.
template <class Body>
void for_chunks(std::size_t count, const Body& body) {
  const auto chunks = static_cast<std::int64_t>(chunk_count(count));
#pragma omp parallel for schedule(dynamic) if (chunks > 1)
  for (std::int64_t i = 0; i < chunks; ++i) {
    const auto number = static_cast<std::size_t>(i);
    body(Chunk{number, number * chunk_size, std::min(count, (number + 1) * chunk_size)});
  }
}

}  // namespace scree
