#include "engine/base/stage_clock.h"

#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace scree {
namespace {

constexpr std::size_t mebibyte = 1024 * 1024;

TEST(StageClock, MeasuresTheTimeThatPassed) {
  const StageClock clock("wait");
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const StageCost cost = clock.read();
  EXPECT_EQ(cost.name, "wait");
  EXPECT_GE(cost.wall_seconds, 0.03);
  EXPECT_LT(cost.wall_seconds, 10);
}

TEST(StageClock, CountsMemoryThatWasHeldForAMomentOnly) {
  const std::int64_t before = StageClock("before").read().peak_memory_bytes;
  const StageClock clock("large");
  { std::vector<char> large(200 * mebibyte, 'x'); }
  EXPECT_GE(clock.read().peak_memory_bytes, before + static_cast<std::int64_t>(190 * mebibyte));
}

TEST(StageClock, LeavesOutWhatIsDoneInAPause) {
  const auto start = std::chrono::steady_clock::now();
  StageClock clock("stage");
  { std::vector<char> large(200 * mebibyte, 'x'); }
  const StageCost first = clock.read();
  clock.pause();
  constexpr double slept = 0.05;
  std::this_thread::sleep_for(std::chrono::duration<double>(slept));
  clock.resume();
  const StageCost both = clock.read();
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  EXPECT_GE(both.wall_seconds, first.wall_seconds);
  EXPECT_LE(both.wall_seconds, whole.count() - slept);
  EXPECT_GE(both.peak_memory_bytes, first.peak_memory_bytes) << "the peak before the pause counts";
}

#ifndef __SANITIZE_ADDRESS__  // which keeps freed memory
TEST(StageClock, AStageDoesNotInheritThePeakOfTheOneBefore) {
  const StageClock large("large");
  { std::vector<char> block(200 * mebibyte, 'x'); }
  const std::int64_t peak = large.read().peak_memory_bytes;
  EXPECT_LT(StageClock("small").read().peak_memory_bytes, peak - static_cast<std::int64_t>(190 * mebibyte));
}
#endif

}  // namespace
}  // namespace scree
