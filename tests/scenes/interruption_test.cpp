// Runs of the command that are stopped on their way: what they leave is readable, and resuming gives the same result.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <spawn.h>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "engine/base/files_together.h"
#include "tests/scenes/scene_run.h"
#include "tools/run/begin_results.h"
#include "tools/scene/read_scene.h"

extern char** environ;

namespace scree::test {
namespace {

using Arguments = std::vector<std::string>;

pid_t start(const Arguments& arguments) {
  Arguments words{SCREE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.emplace_back("--quiet");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  EXPECT_EQ(posix_spawn(&child, SCREE_PROGRAM, nullptr, nullptr, argv.data(), environ), 0);
  return child;
}

// The exit status, or minus the signal that ended it.
int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// Heat with many output times, so that a signal finds the run on its way.
Arguments heat_in(const std::filesystem::path& directory) {
  const auto scene = std::filesystem::path(SCREE_SOURCE_DIR) / "scenes" / "bars_and_joint.yaml";
  return {"run", scene.string(), "--out", directory.string(), "--set", "heat.until=30 min", "--set", "output.every=5 s"};
}

// Whole ones; the .pvd may name them later.
std::size_t written_frames(const std::filesystem::path& directory) {
  std::error_code not_there_yet;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "heat", not_there_yet)) {
    count += entry.path().filename().string().starts_with("heat_") ? 1 : 0;
  }
  return count;
}

void stop_after_some_frames(pid_t child, const std::filesystem::path& directory, int signal) {
  for (int i = 0; i < 2000 && written_frames(directory) < 10; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, signal);
  if (signal == SIGTERM) kill(child, signal);  // as `timeout` does: first its child, then the group
}

class Interruption : public ::testing::TestWithParam<int> {
 protected:
  static void SetUpTestSuite() {
    whole_ = fresh_directory("uninterrupted");
    ASSERT_EQ(wait_for(start(heat_in(whole_))), 0);
  }

  static inline std::filesystem::path whole_;
};

TEST_P(Interruption, LeavesReadableFramesAndResumesToTheSameResult) {
  const auto directory = fresh_directory("interrupted_" + std::to_string(GetParam()));
  const pid_t child = start(heat_in(directory));
  stop_after_some_frames(child, directory, GetParam());
  EXPECT_EQ(wait_for(child), GetParam() == SIGKILL ? -SIGKILL : 130);

  const auto left = listed_frames(directory / "heat.pvd");
  // A run that is told to stop names all its frames and keeps its last state, however short it was; one that is killed may lose
  // a second of work.
  const bool told = GetParam() != SIGKILL;
  EXPECT_GE(written_frames(directory), 10u);
  EXPECT_GE(left.size(), told ? written_frames(directory) : 1u);
  EXPECT_LT(left.size(), 361u) << "the run had ended before it was stopped";
  for (const auto& frame : left) EXPECT_EQ(contents(directory / frame), contents(whole_ / frame));
  EXPECT_NE(nlohmann::json::parse(contents(directory / "summary.json"))["status"], "complete");
  EXPECT_TRUE(!told || std::filesystem::exists(directory / "heat.restart.h5"));

  EXPECT_EQ(wait_for(start({"resume", directory.string()})), 0);
  EXPECT_EQ(contents(directory / "probes.csv"), contents(whole_ / "probes.csv"));
  EXPECT_EQ(contents(directory / "heat.pvd"), contents(whole_ / "heat.pvd"));
  for (const char* series : {"heat.pvd", "contacts.pvd"}) {
    for (const auto& frame : listed_frames(directory / series))
      EXPECT_EQ(contents(directory / frame), contents(whole_ / frame));
  }
  auto resumed = nlohmann::json::parse(contents(directory / "summary.json"));
  auto uninterrupted = nlohmann::json::parse(contents(whole_ / "summary.json"));
  EXPECT_EQ(resumed["heat"]["ledger"], uninterrupted["heat"]["ledger"]);
  EXPECT_EQ(resumed["heat"]["steps"], uninterrupted["heat"]["steps"]);
}

INSTANTIATE_TEST_SUITE_P(Signals, Interruption, ::testing::Values(SIGINT, SIGTERM, SIGKILL));

TEST(InterruptedRun, IsNotGoneOnFromByAnotherVersionWhichLeavesItAsItIs) {
  const auto directory = fresh_directory("of_another_version");
  ASSERT_EQ(wait_for(start(heat_in(directory))), 0);
  nlohmann::json summary = nlohmann::json::parse(contents(directory / "summary.json"));
  summary["version"] = "0.0.1";
  const std::string probes = contents(directory / "probes.csv");
  std::ofstream(directory / "summary.json") << summary.dump();
  EXPECT_EQ(wait_for(start({"resume", directory.string()})), 2);
  EXPECT_EQ(contents(directory / "summary.json"), summary.dump());
  EXPECT_EQ(contents(directory / "probes.csv"), probes);
}

// Frames are of t = 0 and of the end only; rows of probes tell how far the run is. It goes on from where it was stopped.
TEST(InterruptedRun, KeepsItsStateBetweenFrames) {
  const auto whole = fresh_directory("two_frames"), directory = fresh_directory("two_frames_interrupted");
  const auto arguments = [](const std::filesystem::path& out) {
    Arguments words = heat_in(out);
    for (const char* override : {"heat.until=60 min", "output.every=1 s", "output.frames_every=60 min",
                                 "heat.integrator=explicit_euler", "heat.step=50 ms"}) {
      words.insert(words.end(), {"--set", override});
    }
    return words;
  };
  ASSERT_EQ(wait_for(start(arguments(whole))), 0);
  const pid_t child = start(arguments(directory));
  for (int i = 0; i < 2000 && contents(directory / "probes.csv").size() < 30000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130);
  EXPECT_EQ(listed_frames(directory / "heat.pvd").size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(directory / "heat.restart.h5"));
  EXPECT_EQ(wait_for(start({"resume", directory.string()})), 0);
  EXPECT_EQ(contents(directory / "probes.csv"), contents(whole / "probes.csv"));
  EXPECT_EQ(contents(directory / "heat.pvd"), contents(whole / "heat.pvd"));
}

// As there is no folder for Gmsh to read the mesh from.
TEST(ARunThatFailsBeforeItHasBegun, LeavesAnEarlierResultAsItIs) {
  const auto directory = fresh_directory("failed_before_it_began");
  const auto scene = std::filesystem::path(SCREE_SOURCE_DIR) / "scenes" / "ring.yaml";
  const Arguments again{"run", scene.string(), "--out", directory.string()};
  ASSERT_EQ(wait_for(start(again)), 0);
  const std::string summary = contents(directory / "summary.json"), index = contents(directory / "heat.pvd");
  const char* before = std::getenv("TMPDIR");
  const std::string folder = before != nullptr ? before : "/tmp";
  setenv("TMPDIR", "/nowhere", 1);
  EXPECT_EQ(wait_for(start(again)), 1);
  setenv("TMPDIR", folder.c_str(), 1);
  EXPECT_EQ(contents(directory / "summary.json"), summary);
  EXPECT_EQ(contents(directory / "heat.pvd"), index);
  EXPECT_TRUE(std::filesystem::exists(directory / listed_frames(directory / "heat.pvd").back()));
}

// Whatever ends the run before its first frames have their names.
TEST(InterruptedRun, HasItsSceneAndThatItGoesOnUnderTheirNamesFromItsBeginning) {
  const auto directory = fresh_directory("begun");
  ASSERT_EQ(wait_for(start(heat_in(directory))), 0);
  std::ofstream(directory / "heat.png") << "a picture";
  const Scene scene = read_scene(directory / "scene.yaml", {"heat.until=1 h"});
  Progress progress(ProgressMode::quiet);
  run::RunContext context{.scene = scene, .files = {directory}, .progress = progress};
  FilesTogether waiting;
  const FilesTogether::Scope scope(waiting);
  run::begin_results(context);
  EXPECT_EQ(nlohmann::json::parse(contents(directory / "summary.json"))["status"], "running");
  EXPECT_EQ(contents(directory / "scene.yaml"), scene.effective);
  for (const char* gone : {"heat.pvd", "probes.csv", "heat.restart.h5", "heat.png"}) {
    EXPECT_FALSE(std::filesystem::exists(directory / gone)) << gone;
  }
}

}  // namespace
}  // namespace scree::test
