// What a program says of the libraries that it was built with.
#include "engine/base/version.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(Version, EveryLibraryHasOneThatBeginsWithANumber) {
  EXPECT_FALSE(library_versions().empty());
  for (const LibraryVersion& library : library_versions()) {
    ASSERT_FALSE(library.version.empty()) << library.name;
    EXPECT_GE(library.version.front(), '0') << library.name;
    EXPECT_LE(library.version.front(), '9') << library.name;
  }
}

}  // namespace
}  // namespace scree
