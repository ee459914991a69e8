#include "engine/base/threads.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <thread>

#include <gtest/gtest.h>

#include "engine/base/brief_waits.h"

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

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

TEST(WaitBriefly, LeavesTheProcessorOfThreadsThatWaitToOthers) {
  const int all = available_processors();
  if (all == 1) GTEST_SKIP() << "one processor has one thread";
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) {
    GTEST_SKIP() << "the environment says how to wait";
  }
  const int before = threads_in_use();
  use_threads(all);
  wait_briefly();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // for threads that are new
  const double start = processor_seconds();
  constexpr int loops = 20;
  for (int loop = 0; loop < loops; ++loop) {
#pragma omp parallel for
    for (int i = 0; i < all; ++i) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  // A thread that waits actively does so for some 3 ms after each.
  EXPECT_LT(processor_seconds() - start, loops * 1e-3);
  use_threads(before);
}

}  // namespace
}  // namespace scree
