#include "engine/base/phases.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
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

// Helpers that come late to one work meet the next, with other sizes and other numbers of threads.
TEST(RunPhases, DoesEveryTaskOnceInWorksThatFollowEachOther) {
  std::vector<std::atomic<int>> done(40);
  int wrong = 0;
  for (int work = 0; work < 3000; ++work) {
    use_threads(1 + work % 4);
    const std::array<int, 2> sizes{1 + work % 37, 2 + work % 5};
    for (std::atomic<int>& count : done) count = 0;
    run_phases(sizes, 2, [&](int, int number) { ++done[static_cast<std::size_t>(number)]; });
    for (int number = 0; number < 40; ++number) {
      const int wanted = 2 * ((number < sizes[0] ? 1 : 0) + (number < sizes[1] ? 1 : 0));
      wrong += done[static_cast<std::size_t>(number)] != wanted;
    }
  }
  EXPECT_EQ(wrong, 0);
  use_threads(available_processors());
}

// However long the others take: who is done with its own tasks takes theirs.
TEST(RunPhases, ATaskThatTakesLongHoldsUpNoOther) {
  use_threads(2);
  std::atomic<int> others{0};
  run_phases(std::array<int, 1>{8}, 1, [&](int, int number) {
    if (number != 0) {
      ++others;
    } else {  // a bound, so that a fault ends the test and does not hang it
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (others < 7 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
      EXPECT_EQ(others, 7);
    }
  });
  use_threads(available_processors());
}

TEST(RunPhases, ThrowsOnWhatATaskThrowsAndDoesTheNextWorkAsEver) {
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    for (int thrower = 0; thrower < 40; ++thrower) {
      const auto work = [&](int phase, int number) {
        if (phase == 1 && number == thrower) throw std::runtime_error("no memory");
      };
      EXPECT_THROW(run_phases(std::array<int, 3>{40, 40, 40}, 2, work), std::runtime_error) << threads;
      std::atomic<int> done{0};
      run_phases(std::array<int, 2>{7, 30}, 3, [&](int, int) { ++done; });
      EXPECT_EQ(done, 111) << threads;
    }
  }
  use_threads(available_processors());
}

TEST(RunPhases, OfNoTasksIsOverAtOnce) {
  run_phases(std::array<int, 2>{0, 0}, 3, [](int, int) { FAIL(); });
}

}  // namespace
}  // namespace scree
