#include "engine/base/collected.h"

#include <gtest/gtest.h>

#include "engine/base/threads.h"

namespace scree {
namespace {

// Some numbers of each index, more of some than of others, so that lists have to grow.
void append(Chunk chunk, std::vector<std::size_t>& into) {
  for (std::size_t i = chunk.begin; i < chunk.end; ++i) into.insert(into.end(), i / 1000 % 4, i);
}

TEST(Collected, IsWhatOneChunkAfterTheOtherAppendsForAnyNumberOfThreads) {
  const int before = threads_in_use();
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, 64 * chunk_size, 3 * 64 * chunk_size + 17}) {
    std::vector<std::size_t> expected;
    append({0, 0, count}, expected);
    for (const int threads : {1, 2, 5}) {
      use_threads(threads);
      EXPECT_EQ(collected<std::vector<std::size_t>>(count, append), expected) << count << " on " << threads;
    }
  }
  use_threads(before);
}

}  // namespace
}  // namespace scree
