// The command as a user meets it: exit statuses, and that bad input leaves nothing behind.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include <sys/wait.h>

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"
#include "tools/run/file_lock.h"

namespace scree::test {
namespace {

struct Outcome {
  int status = 0;
  std::string text;  // of standard output and standard error
};

Outcome scree(const std::string& arguments) {
  const auto log = fresh_directory("command") / "log";
  const int status =
      std::system(("{ " + std::string(SCREE_PROGRAM) + " " + arguments + "; } > " + log.string() + " 2>&1").c_str());
  return {WEXITSTATUS(status), contents(log)};
}

std::string scene(const std::string& name) {
  return std::string(SCREE_SOURCE_DIR) + "/scenes/" + name + ".yaml";
}

// Of the small scenes: small_pile_reheated needs an earlier run, and the large piles are meshed for seconds.
TEST(Command, ChecksEverySceneWithoutRunningIt) {
  const std::set<std::string> left_out{"small_pile_reheated", "pile", "pile_undamped"};
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SCREE_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".yaml" || left_out.contains(entry.path().stem().string())) continue;
    const Outcome outcome = scree("check " + entry.path().string());
    EXPECT_EQ(outcome.status, 0) << entry.path() << "\n" << outcome.text;
    EXPECT_NE(outcome.text.find("nothing is suspicious"), std::string::npos) << entry.path() << "\n" << outcome.text;
  }
}

TEST(Command, RefusesBadInputBeforeAnyWorkAndLeavesNothing) {
  const auto directory = fresh_directory("refused") / "out";
  const Outcome outcome = scree("run " + scene("slab") + " --out " + directory.string() +
                                " --set materials.soil.conductivity=-2 --set heat.untill=60 --set heat.tolerance=\"3 m\"");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.text.find("materials.soil.conductivity is -2"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("Did you mean until?"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("heat.tolerance is 3 m"), std::string::npos) << outcome.text;
  EXPECT_FALSE(std::filesystem::exists(directory));
}

TEST(Command, SaysWhatADirectoryThatCannotBeWrittenIs) {
  const Outcome outcome = scree("run " + scene("slab") + " --out /proc/nowhere");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("/proc/nowhere"), std::string::npos) << outcome.text;
}

TEST(Command, RefusesNamesThatMeanNothingInWordsThatSayWhat) {
  const auto expect_refused = [](const std::string& arguments, int status, const std::string& words) {
    const Outcome outcome = scree(arguments);
    EXPECT_EQ(outcome.status, status) << arguments;
    EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
  };
  expect_refused("keys nothing.like", 2, "nothing.like (must begin a key of a scene)");
  const auto empty = fresh_directory("not_a_run");
  expect_refused("resume " + empty.string(), 2, "(must be that of a run, which holds its scene.yaml)");
  expect_refused("accuracy " + scene("slab") + " --out /proc/nowhere", 1, "/proc/nowhere: cannot be created");
  expect_refused("run " + scene("slab") + " --out " + scene("bar"), 2, "bar.yaml (must be a folder");
  expect_refused("run " + scene("slab") + " --out " + scene("bar") + "/deeper", 2, "bar.yaml/deeper (must be a folder");
  expect_refused("chekc " + scene("slab"), 2, "chekc is no command. Did you mean check?");
}

// As a variable of a shell that is not set: it must not be taken for an option that was left away.
TEST(Command, RefusesOptionsWithAnEmptyValue) {
  const std::string study = std::string(SCREE_SOURCE_DIR) + "/scenes/studies/heating_time.yaml";
  for (const std::string& arguments : {"run " + scene("slab") + " --out ''", "check " + scene("slab") + " --set ''",
                                       "study " + study + " --slurm ''", std::string("report ''")}) {
    const Outcome outcome = scree(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.text.find("must not be empty"), std::string::npos) << outcome.text;
  }
}

TEST(Command, FailsIfWhatItPrintsDoesNotArrive) {
  for (const std::string& arguments : {"check " + scene("slab"), std::string("run --help"), std::string("--version")}) {
    const int status = std::system((std::string(SCREE_PROGRAM) + " " + arguments + " > /dev/full").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
  }
}

// Of the system for the size of files: the summary is small enough to be written yet.
TEST(Command, SaysWhichFileALimitKeepsFromGrowing) {
  const auto directory = fresh_directory("limited");
  const auto log = fresh_directory("limited_log") / "log";
  const int status = std::system(("ulimit -f 16; " + std::string(SCREE_PROGRAM) + " run " + scene("bars_and_joint") +
                                  " --quiet --out " + directory.string() + " > " + log.string() + " 2>&1")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(contents(log).find("File too large"), std::string::npos) << contents(log);
  EXPECT_EQ(nlohmann::json::parse(contents(directory / "summary.json"))["status"], "failed");
}

TEST(Command, IsSilentWhenAskedTo) {
  const auto directory = fresh_directory("silent");
  const Outcome outcome = scree("run " + scene("slab") + " --quiet --out " + directory.string());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.text, "");
}

TEST(Command, PrintsItsKeysAndASchemaThatNamesThem) {
  EXPECT_NE(scree("keys heat").text.find("heat.tolerance"), std::string::npos);
  const auto schema = nlohmann::json::parse(scree("schema").text);
  EXPECT_TRUE(schema["properties"].contains("materials"));
}

TEST(Command, RefusesWordsItDoesNotKnowWithStatusTwo) {
  EXPECT_EQ(scree("walk").status, 2);
  EXPECT_EQ(scree("run").status, 2);
  EXPECT_EQ(scree("run nowhere.yaml").status, 2);
  EXPECT_EQ(scree("--help").status, 0);
}

TEST(Command, TellsErrorAgainstCostAndDrawsIt) {
  const auto directory = fresh_directory("accuracy");
  const Outcome outcome =
      scree("accuracy " + scene("slab") +
            R"( --quiet --mesh 2 1 --tolerance "1 K" "0.1 K" "0.01 K" --set heat.until="10 s" --out )" + directory.string());
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("against the exact solution of the scene"), std::string::npos) << outcome.text;
  EXPECT_EQ(outcome.text.find("reference"), std::string::npos) << "the finest run has an error, too";
  EXPECT_NE(outcome.text.find("observed order in time step"), std::string::npos) << outcome.text;
  EXPECT_GT(std::filesystem::file_size(directory / "accuracy.png"), 10000u);
  const std::string table = contents(directory / "accuracy.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
}

TEST(Command, MakesALadderAgainIntoItsFolder) {
  const std::string ladder = "accuracy " + scene("slab") + R"( --quiet --mesh 2 1 --tolerance "1 K" --set heat.until="10 s")";
  const auto directory = fresh_directory("accuracy_twice");
  {
    const auto lock = run::FileLock::take(directory / ".lock", run::FileLock::Kind::exclusive, run::FileLock::Heirs::none);
    EXPECT_NE(scree(ladder + " --out " + directory.string()).text.find("is at work there"), std::string::npos);
  }
  std::filesystem::create_directory(directory / "run_01");
  std::ofstream(directory / "run_01" / "summary.json") << "{}";
  EXPECT_EQ(scree(ladder + " --out " + directory.string()).status, 2) << "a run that it has not made";
  EXPECT_EQ(contents(directory / "run_01" / "summary.json"), "{}");
  std::filesystem::remove_all(directory / "run_01");
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = scree(ladder + " --out " + directory.string());
    EXPECT_EQ(outcome.status, 0) << outcome.text;
  }
  const std::string table = contents(directory / "accuracy.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << table;
}

// A steady state that is there from the start takes no step, and is a run all the same.
TEST(Command, TellsTheErrorsOfRunsThatNeedNoStep) {
  const auto directory = fresh_directory("accuracy_of_no_step");
  std::ofstream(directory / "warm.yaml") << R"(
dimension: 2
materials: {rock: {density: 2500, conductivity: 3, specific_heat: 880}}
bodies: {a: {box: {size: [1, 1], centre: [0, 0]}, material: rock, mesh_size: 0.3}}
heat: {initial: 300, steady: true, boundaries: [{body: a, temperature: 300}]}
output: {probes: {p: {point: [0, 0], exact: 300}}}
)";
  const Outcome outcome =
      scree("accuracy " + (directory / "warm.yaml").string() + " --quiet --mesh 1 0.5 --out " + (directory / "out").string());
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

// Stops the command when a run of it has begun: the second one unless told.
Outcome interrupted_accuracy(const std::string& scene_name, const std::filesystem::path& directory,
                             const std::string& run = "run_01") {
  return scree("accuracy " + scene(scene_name) + R"( --quiet --tolerance "1 K" "0.1 K" "0.01 K" --mesh 1 --out )" +
               directory.string() + " & all=$!; for i in $(seq 3000); do [ -e " + (directory / run / "log").string() +
               " ] && break; sleep 0.01; done; kill -TERM $all; wait $all");
}

TEST(Command, TellsTheErrorsOfTheRunsThatWereDoneWhenInterrupted) {
  const auto directory = fresh_directory("interrupted_accuracy");
  const Outcome exact = interrupted_accuracy("slab", directory / "slab");
  EXPECT_EQ(exact.status, 130) << exact.text;
  EXPECT_NE(exact.text.find("interrupted after 1 of 3 runs"), std::string::npos) << exact.text;
  EXPECT_NE(exact.text.find("against the exact solution of the scene"), std::string::npos) << exact.text;
  const std::string table = contents(directory / "slab/accuracy.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2) << table;
  const Outcome without = interrupted_accuracy("bars_and_joint", directory / "bars");
  EXPECT_EQ(without.status, 130) << without.text;
  EXPECT_NE(without.text.find("errors are not known"), std::string::npos) << without.text;
  EXPECT_EQ(without.text.find("reference"), std::string::npos) << without.text;
  EXPECT_TRUE(std::filesystem::exists(directory / "bars/accuracy.csv"));
}

TEST(Command, LeavesNoErrorsOfAnEarlierLadderWhenInterruptedInTheFirstRun) {
  const auto directory = fresh_directory("accuracy_again");
  for (const char* name : {"accuracy.csv", "accuracy.png"}) std::ofstream(directory / name) << "of an earlier ladder";
  const Outcome outcome = interrupted_accuracy("slab", directory, "run_00");
  EXPECT_EQ(outcome.status, 130) << outcome.text;
  for (const char* name : {"accuracy.csv", "accuracy.png"}) EXPECT_FALSE(std::filesystem::exists(directory / name)) << name;
}

TEST(Command, LeavesAnEarlierLadderWhereAnotherIsRefused) {
  const auto directory = fresh_directory("accuracy_refused");
  std::ofstream(directory / "accuracy.csv") << "of an earlier ladder";
  EXPECT_EQ(scree("accuracy " + scene("slab") + " --quiet --contact nothing --out " + directory.string()).status, 2);
  EXPECT_EQ(contents(directory / "accuracy.csv"), "of an earlier ladder");
}

TEST(Command, EstimatesTheSpaceErrorWhenAskedTo) {
  const auto directory = fresh_directory("space_error");
  for (const std::string size : {"0.02", "0.01"}) {
    ASSERT_EQ(scree("run " + scene("slab") + " --quiet --error-estimate --set bodies.bar.mesh_size=" + size + " --out " +
                    (directory / size).string())
                  .status,
              0);
  }
  const auto largest = [&](const std::string& size) {
    return nlohmann::json::parse(contents(directory / size / "summary.json"))["heat"]["space_error"]["largest"].get<double>();
  };
  EXPECT_GT(largest("0.02") / largest("0.01"), 2);
  EXPECT_NE(contents(directory / "0.01/heat/heat_000001.vtu").find("space_error"), std::string::npos);
}

TEST(Command, LeavesNothingOfAnEarlierRunThatThisOneDoesNotMake) {
  const auto directory = fresh_directory("second_run");
  ASSERT_EQ(scree("run " + scene("bars_and_joint") + " --quiet --set heat.until=\"1 h\" --out " + directory.string()).status,
            0);
  const std::set<std::string> of_heat{"heat.pvd", "contacts.pvd", "probes.csv", "heat.restart.h5"};
  for (const std::string& file : of_heat) EXPECT_TRUE(std::filesystem::exists(directory / file)) << file;
  const Outcome fall = scree("run " + scene("falling_cube") + " --out " + directory.string());
  ASSERT_EQ(fall.status, 0);
  EXPECT_NE(fall.text.find("1 of 2 blocks fall"), std::string::npos) << fall.text;
  for (const std::string& file : of_heat) EXPECT_FALSE(std::filesystem::exists(directory / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(directory / "heat"));
  EXPECT_TRUE(std::filesystem::exists(directory / "settle.pvd"));
}

TEST(Command, RefusesADirectoryThatAnotherRunWritesTo) {
  const auto directory = fresh_directory("taken");
  std::filesystem::create_directories(directory);
  const auto lock = run::FileLock::take(directory / ".lock", run::FileLock::Kind::exclusive, run::FileLock::Heirs::none);
  ASSERT_TRUE(lock);
  const Outcome outcome = scree("run " + scene("slab") + " --quiet --out " + directory.string());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("another run writes there"), std::string::npos) << outcome.text;
  EXPECT_FALSE(std::filesystem::exists(directory / "summary.json"));
}

TEST(Command, DrawsARunWithoutAScreen) {
  const auto directory = fresh_directory("drawn");
  ASSERT_EQ(scree("run " + scene("bars_and_joint") + " --quiet --set heat.until=\"2 h\" --out " + directory.string()).status,
            0);
  const Outcome outcome = scree("render " + directory.string() + R"( --time "1 h" --cut "0 m")");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_GT(std::filesystem::file_size(directory / "heat.png"), 10000u);
  const auto said = [&](const std::string& option) { return scree("render " + directory.string() + " " + option).text; };
  EXPECT_NE(said("--time 3599").find("nearest to 3599, at 3600 s"), std::string::npos) << said("--time 3599");
  EXPECT_NE(said("--series settle").find("There is heat, contacts"), std::string::npos) << said("--series settle");
  for (const char* wrong : {"--view 1 1 1 0 0 0", "--picture picture.jpg", "--picture /nowhere/picture.png", "--time \"-1 s\"",
                            "--animation a.webm --picture a.png", "--animation a.webm --duration \"0 s\"",
                            "--animation a.webm --duration \"2 h\""}) {
    EXPECT_EQ(scree("render " + directory.string() + " " + wrong).status, 2) << wrong;
  }
}

TEST(Command, LeavesNoPartOfAnAnimationThatIsStopped) {
  const auto directory = fresh_directory("filmed");
  ASSERT_EQ(scree("run " + scene("bars_and_joint") + " --quiet --set heat.until=\"10 min\" --set output.every=\"5 s\" --out " +
                  directory.string())
                .status,
            0);
  const std::string part = (directory / ".part-heat.mp4").string();
  const Outcome outcome = scree("render " + directory.string() + " --animation " + (directory / "heat.mp4").string() +
                                " & film=$!; for i in $(seq 3000); do [ -e " + part +
                                " ] && break; sleep 0.01; done; kill -TERM $film; wait $film");
  EXPECT_EQ(outcome.status, 130) << outcome.text;
  for (const char* name : {".part-heat.mp4", "heat.mp4"}) EXPECT_FALSE(std::filesystem::exists(directory / name)) << name;
}

}  // namespace
}  // namespace scree::test
