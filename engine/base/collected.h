// What a loop over many small pieces of work gives, in one vector.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/base/chunks.h"

namespace scree {

// What work(chunk, into) appends for every chunk of [0, count), in order. On all threads, some chunks at a time: what they give
// is copied while it is in the cache, and its memory is used again.
template <class Items, class Work>
Items collected(std::size_t count, const Work& work) {
  constexpr std::size_t group = 16 * chunk_size;
  Items items;
  std::vector<std::vector<typename Items::value_type>> parts(chunk_count(group));
  std::vector<std::size_t> ends(parts.size());
  for (std::size_t from = 0; from < count; from += group) {
    const std::size_t some = std::min(group, count - from);
    for_chunks(some, [&](Chunk chunk) {
      parts[chunk.number].clear();
      work(Chunk{chunk.number, from + chunk.begin, from + chunk.end}, parts[chunk.number]);
    });
    std::size_t all = items.size();
    for (std::size_t i = 0; i < chunk_count(some); ++i) ends[i] = all += parts[i].size();
    // As many as there will be if it goes on like this.
    const double share = static_cast<double>(from + some) / static_cast<double>(count);
    if (all > items.capacity()) items.reserve(static_cast<std::size_t>(1.05 * static_cast<double>(all) / share) + 1);
    items.resize(all);
    for_chunks(some, [&](Chunk chunk) {
      const auto& part = parts[chunk.number];
      std::copy(part.begin(), part.end(), items.begin() + static_cast<std::ptrdiff_t>(ends[chunk.number] - part.size()));
    });
  }
  return items;
}

}  // namespace scree
