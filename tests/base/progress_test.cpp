#include "engine/base/progress.h"

#include <cstdlib>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace scree {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

struct Watched {
  explicit Watched(ProgressMode mode, int width = 80)
      : progress(
            mode, out, [this] { return now; }, width) {}

  std::ostringstream out;
  double now = 100;
  Progress progress;
};

TEST(Progress, ALogGetsALineAtStartAndEndAndEveryTenSeconds) {
  Watched watched(ProgressMode::lines);
  watched.progress.start("heat", "7552 blocks");
  for (int second = 1; second <= 25; ++second) {
    watched.now += 1;
    watched.progress.update(second / 50.0, "step");
  }
  watched.progress.finish("25 steps");
  EXPECT_EQ(watched.out.str(),
            "heat: 7552 blocks\n"
            "heat: 20 %, 40 s left, step\n"
            "heat: 40 %, 30 s left, step\n"
            "heat: done in 25 s, 25 steps\n");
}

TEST(Progress, ATerminalLineRenewsItselfAndEndsAsAWholeLine) {
  Watched watched(ProgressMode::terminal);
  watched.progress.start("heat", "begins");
  watched.now += 2;
  watched.progress.update(0.25, "step 1");
  watched.progress.finish("");
  EXPECT_EQ(watched.out.str(), "heat: 0 %, begins\r\x1b[Kheat: 25 %, 6 s left, step 1\r\x1b[Kheat: done in 2.00 s\n");
}

TEST(Progress, AProgramGetsAnObjectALineAndAnUpdateASecond) {
  Watched watched(ProgressMode::json);
  watched.progress.start("heat", "a \"quoted\" word");
  for (int i = 1; i <= 8; ++i) {
    watched.now += 0.5;
    watched.progress.update(i / 16.0, "step");
  }
  watched.progress.finish("25 steps");
  watched.progress.note("mind\nthis");
  watched.progress.end({"not_converged", 1, "out/pile", {"why"}});
  std::vector<nlohmann::json> objects;
  std::istringstream lines(watched.out.str());
  for (std::string line; std::getline(lines, line);) objects.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(objects.size(), 8U);
  EXPECT_EQ(objects[0], (nlohmann::json{{"event", "start"}, {"stage", "heat"}, {"text", "a \"quoted\" word"}}));
  EXPECT_EQ(objects[4]["event"], "progress");
  EXPECT_EQ(objects[4]["fraction"], 0.5);
  EXPECT_NEAR(objects[4]["seconds_left"], 4, 0.01);
  EXPECT_EQ(objects[5]["seconds"], 4);
  EXPECT_EQ(objects[6]["text"], "mind\nthis");
  EXPECT_EQ(
      objects[7],
      (nlohmann::json{
          {"event", "end"}, {"status", "not_converged"}, {"exit_status", 1}, {"directory", "out/pile"}, {"reasons", {"why"}}}));
}

TEST(Progress, TheEndIsColouredOnATerminalOnlyAndNotWhereNobodyWantsColours) {
  const auto end = [](ProgressMode mode, int exit_status) {
    Watched watched(mode);
    watched.progress.end({"ended", exit_status, "out", {}});
    return watched.out.str();
  };
  ::unsetenv("NO_COLOR");
  EXPECT_EQ(end(ProgressMode::terminal, 0), "\x1b[32mended\x1b[0m: out\n");
  EXPECT_EQ(end(ProgressMode::terminal, 1), "\x1b[31mended\x1b[0m: out\n");
  EXPECT_EQ(end(ProgressMode::lines, 1), "ended: out\n");
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_EQ(end(ProgressMode::terminal, 1), "ended: out\n");
  ::unsetenv("NO_COLOR");
}

TEST(Progress, ManyUpdatesAMomentApartDrawLittle) {
  Watched watched(ProgressMode::terminal);
  watched.progress.start("heat", "");
  const auto before = watched.out.str().size();
  for (int i = 0; i < 99; ++i) {
    watched.now += 0.001;
    watched.progress.update(i / 1e3, "step");
  }
  EXPECT_EQ(watched.out.str().size(), before);
}

TEST(Progress, ALineIsNoWiderThanTheTerminal) {
  Watched watched(ProgressMode::terminal, 20);
  watched.progress.start("heat", "a text that is much too long for it");
  EXPECT_EQ(watched.out.str().size(), 19u);
}

TEST(Progress, AQuietRunSaysNothing) {
  {
    Watched watched(ProgressMode::quiet);
    watched.progress.start("heat", "x");
    watched.now += 60;
    watched.progress.update(0.5, "x");
    watched.progress.note("x");
    watched.progress.finish("x");
    EXPECT_EQ(watched.out.str(), "");
  }
  EXPECT_EQ(progress_mode(true), ProgressMode::quiet);
}

TEST(Progress, ANoteStaysAboveTheRenewedLine) {
  Watched watched(ProgressMode::terminal);
  watched.progress.start("settle", "begins");
  watched.progress.note("block 12 left the scene");
  EXPECT_THAT(watched.out.str(), EndsWith("\r\x1b[Kblock 12 left the scene\n"));
}

TEST(Progress, AStageLeftByAnErrorEndsItsLine) {
  std::ostringstream out;
  {
    Progress progress(
        ProgressMode::terminal, out, [] { return 0.0; }, 80);
    progress.start("settle", "begins");
  }
  EXPECT_THAT(out.str(), EndsWith("begins\n"));
}

TEST(Progress, TimeLeftFollowsTheRecentRateNotTheMeanSinceTheStart) {
  Watched watched(ProgressMode::lines);
  watched.progress.start("settle", "begins");
  double fraction = 0;
  // Ten slow seconds, then ten times faster until 90 s: the last 10 % take 10 s more.
  for (int second = 1; second <= 90; ++second) {
    watched.now += 1;
    fraction = second <= 10 ? 0.001 * second : 0.01 + 0.01 * (second - 10);
    watched.progress.update(fraction, "");
  }
  EXPECT_THAT(watched.out.str(), HasSubstr("settle: 81 %, 20 s left"));
}

TEST(FormatDuration, UsesTheTwoLargestUnits) {
  EXPECT_EQ(format_duration(0), "0 s");
  EXPECT_EQ(format_duration(7.2), "8 s");
  EXPECT_EQ(format_duration(200), "3 min 20 s");
  EXPECT_EQ(format_duration(7500), "2 h 05 min");
  EXPECT_EQ(format_duration(1e12), "277777777 h 46 min");
}

}  // namespace
}  // namespace scree
