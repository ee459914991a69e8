// What the command knows of itself: completion and manual follow its own table of options; progress for programs.

#include <cstdlib>
#include <sstream>

#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

using ::testing::HasSubstr;

const std::string program = SCREE_PROGRAM;

// Standard output of a shell's command, which must succeed.
std::string said(const std::string& command) {
  const auto log = fresh_directory("command_line") / "log";
  const int status = std::system((command + " > " + log.string()).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 0) << command;
  return contents(log);
}

// What bash offers after these words.
std::string offered(const std::string& words, int at) {
  return said("bash -c 'source <(" + program + " completion bash); COMP_WORDS=(" + words +
              "); COMP_CWORD=" + std::to_string(at) + "; _scree; echo ${COMPREPLY[@]}'");
}

TEST(CommandLine, BashCompletesCommandsOptionsAndChoices) {
  EXPECT_EQ(offered("scree re", 1), "resume render report\n");
  EXPECT_EQ(offered("scree run scenes/slab.yaml --err", 3), "--error-estimate\n");
  EXPECT_EQ(offered("scree render out --series s", 4), "settle\n");
  EXPECT_EQ(offered("scree completion \"\"", 2), "bash zsh\n");
  EXPECT_EQ(offered("scree check " + std::string(SCREE_SOURCE_DIR) + "/scenes/sla", 2),
            std::string(SCREE_SOURCE_DIR) + "/scenes/slab.yaml\n");
}

TEST(CommandLine, ASettingMayStandBeforeTheScene) {
  const std::string scene = std::string(SCREE_SOURCE_DIR) + "/scenes/slab.yaml";
  EXPECT_EQ(said(program + " check --set title=before " + scene), said(program + " check " + scene + " --set title=before"));
}

TEST(CommandLine, ZshAcceptsItsFunction) {
  if (std::system("command -v zsh > /dev/null") != 0) GTEST_SKIP() << "zsh is not installed";
  const auto directory = fresh_directory("zsh");
  said(program + " completion zsh | tee " + (directory / "_scree").string());
  EXPECT_EQ(said("zsh -n " + (directory / "_scree").string() + " && echo good"), "good\n");
}

// Every option --help knows stands in the manual and in both completions.
TEST(CommandLine, NothingIsLeftOutOfManualAndCompletion) {
  const std::string manual = said(program + " manual");
  const std::string bash = said(program + " completion bash");
  const std::string zsh = said(program + " completion zsh");
  for (const char* command : {"run", "resume", "check", "render", "report", "accuracy", "study", "plot", "keys"}) {
    EXPECT_THAT(manual, HasSubstr(std::string(".SS scree ") + command));
    std::istringstream help(said(program + " " + command + " --help"));
    for (std::string word; help >> word;) {
      if (!word.starts_with("--") || word.find_first_of("=,.)\"") != std::string::npos) continue;
      std::string escaped;
      for (const char c : word) escaped += c == '-' ? std::string("\\-") : std::string(1, c);
      EXPECT_THAT(manual, HasSubstr(escaped));
      EXPECT_THAT(bash, HasSubstr(word));
      EXPECT_THAT(zsh, HasSubstr(word + "["));
    }
  }
}

TEST(CommandLine, TheManualIsCleanRoff) {
  if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "groff is not installed";
  EXPECT_EQ(said(program + " manual | groff -man -ww -Tascii -z 2>&1"), "");
}

TEST(CommandLine, AProgramReadsAnObjectALineUpToTheEnd) {
  const auto directory = fresh_directory("json");
  const std::string out = said(program + " run " + SCREE_SOURCE_DIR + "/scenes/slab.yaml --json --out " + directory.string());
  std::istringstream lines(out);
  nlohmann::json last;
  std::vector<std::string> finished;
  for (std::string line; std::getline(lines, line);) {
    last = nlohmann::json::parse(line);
    if (last["event"] == "finish") finished.push_back(last["stage"]);
  }
  EXPECT_THAT(finished, ::testing::ElementsAre("mesh", "contacts", "assemble", "heat"));
  EXPECT_EQ(last["event"], "end");
  EXPECT_EQ(last["status"], "complete");
  EXPECT_EQ(last["directory"], directory.string());
}

TEST(CommandLine, AProgramIsToldOfABadSceneToo) {
  const auto log = fresh_directory("json_bad") / "log";
  const std::string command =
      program + " run " + SCREE_SOURCE_DIR + "/scenes/slab.yaml --set heat.until=-1 --json 2> /dev/null";
  const int status = std::system((command + " > " + log.string()).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const auto end = nlohmann::json::parse(contents(log));
  EXPECT_EQ(end["status"], "bad_input");
  EXPECT_THAT(end["reasons"][0].get<std::string>(), HasSubstr("heat.until"));
}

}  // namespace
}  // namespace scree::test
