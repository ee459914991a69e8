#include "engine/base/threads.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(ThreadsInScope, AreOneWhileThereAreTooFewRowsToShareAndAsManyAsBeforeElse) {
  const int before = threads_in_use();
  use_threads(3);
  {
    const ThreadsInScope few(threads_for(rows_worth_sharing - 1));
    EXPECT_EQ(threads_in_use(), 1);
  }
  EXPECT_EQ(threads_in_use(), 3);
  {
    const ThreadsInScope many(threads_for(rows_worth_sharing));
    EXPECT_EQ(threads_in_use(), 3);
  }
  use_threads(before);
}

}  // namespace
}  // namespace scree
