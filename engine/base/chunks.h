// Loops over many small pieces of work on all threads, a chunk of consecutive indices at a time. Where the chunks end does not
// depend on the number of threads, so what is collected chunk by chunk comes in the same order for any.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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

constexpr Chunk chunk_of(std::size_t count, std::size_t number) {
  return {number, number * chunk_size, std::min(count, (number + 1) * chunk_size)};
}

// Chunks of things that differ in size: of consecutive ones that are together as large as `size`, or of one that is larger.
// `ends` are their running sums from 0, one more than there are things.
inline std::vector<Chunk> chunks_by_size(const std::vector<std::size_t>& ends, std::size_t size) {
  std::vector<Chunk> chunks;
  for (std::size_t begin = 0; begin + 1 < ends.size();) {
    std::size_t end = begin + 1;
    while (end + 1 < ends.size() && ends[end + 1] - ends[begin] <= size) ++end;
    chunks.push_back({chunks.size(), begin, end});
    begin = end;
  }
  return chunks;
}

// Calls body(Chunk) for each of these, in no order of note. The body must not throw.
template <class Body>
void for_chunks(const std::vector<Chunk>& chunks, const Body& body) {
#pragma omp parallel for schedule(dynamic) if (chunks.size() > 1)
  for (const Chunk& chunk : chunks) body(chunk);
}

// The same for every chunk of [0, count).
template <class Body>
void for_chunks(std::size_t count, const Body& body) {
  const auto chunks = static_cast<std::int64_t>(chunk_count(count));
#pragma omp parallel for schedule(dynamic) if (chunks > 1)
  for (std::int64_t i = 0; i < chunks; ++i) body(chunk_of(count, static_cast<std::size_t>(i)));
}

}  // namespace scree
