#include "engine/base/phases.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "engine/base/threads.h"

namespace scree {
namespace {

TEST(RunPhases, DoesEveryTaskOnceARoundAndNoneBeforeTheLastPhaseIsOver) {
  constexpr std::array<int, 3> sizes{5, 0, 3};
  constexpr int rounds = 200;
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    std::array<std::vector<int>, 3> done{std::vector<int>(5, 0), std::vector<int>(), std::vector<int>(3, 0)};
    std::atomic<int> early{0};
    run_phases(sizes, rounds, [&](int phase, int number) {
      // All of the other phase are as far as they must be.
      const int round = done[phase][number]++;
      for (const int other : done[2 - phase]) early += other != round + (phase == 2 ? 1 : 0);
    });
    EXPECT_EQ(early, 0) << threads;
    for (const int phase : {0, 2}) EXPECT_EQ(done[phase], std::vector<int>(sizes[phase], rounds)) << threads;
  }
  use_threads(available_processors());
}

TEST(RunPhases, OfNoTasksIsOverAtOnce) {
  run_phases(std::array<int, 2>{0, 0}, 3, [](int, int) { FAIL(); });
}

}  // namespace
}  // namespace scree
