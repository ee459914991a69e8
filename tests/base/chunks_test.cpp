#include "engine/base/chunks.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(ChunksBySize, AreAsLargeAsAllowedAndOneLargeThingIsAChunkOfItsOwn) {
  // Sizes 3, 4, 2, 50, 1, 0, 9.
  const auto chunks = chunks_by_size({0, 3, 7, 9, 59, 60, 60, 69}, 10);
  ASSERT_EQ(chunks.size(), 3);
  const std::vector<std::size_t> ends{3, 4, 7};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    EXPECT_EQ(chunks[i].number, i);
    EXPECT_EQ(chunks[i].begin, begin);
    EXPECT_EQ(chunks[i].end, ends[i]);
    begin = chunks[i].end;
  }
}

TEST(ChunksBySize, OfNothingAreNone) {
  EXPECT_TRUE(chunks_by_size({0}, 10).empty());
}

}  // namespace
}  // namespace scree
