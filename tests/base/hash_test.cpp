#include "engine/base/hash.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(Hasher, GivesThePublishedValueForNoInput) {
  // XXH3-128 of the empty string, seed 0 (xxHash's own test vector).
  EXPECT_EQ(Hasher{}.hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(Hasher, TellsWhereOneTextEndsAndTheNextBegins) {
  EXPECT_NE(Hasher{}.add("ab").add("c").hex(), Hasher{}.add("a").add("bc").hex());
}

TEST(Hasher, DependsOnEveryBitOfANumber) {
  EXPECT_NE(Hasher{}.add(0.1 + 0.2).hex(), Hasher{}.add(0.3).hex());
  EXPECT_EQ(Hasher{}.add(0.3).hex(), Hasher{}.add(0.3).hex());
}

}  // namespace
}  // namespace scree
