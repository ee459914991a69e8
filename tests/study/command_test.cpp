// `scree study` as a user meets it, on a block that falls onto a hot plate.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "engine/output/probe_history.h"
#include "tests/study/one_study.h"
#include "tests/study/study_text.h"

namespace scree::test {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

bool settled_here(const nlohmann::json& summary) {
  return !summary["settle"]["reused"].get<bool>();
}

// What the command says of a study without making it.
Ended listed(const OneStudy& study) {
  return shell(fmt::format("{} study {} --list", SCREE_PROGRAM, study.file.string()), study.file.parent_path());
}

TEST(StudyCommand, SettlesOncePerSeedHeatsEveryRunAndTabulatesThem) {
  const OneStudy study(two_by_two);
  const Ended ended = study.run("--jobs 2");
  ASSERT_EQ(ended.status, 0) << ended.text;
  const study::Table table = study.table();
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_THAT(table.find("status")->texts, Each("complete"));
  int settled = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto summary = study.summary(i);
    settled += settled_here(summary) ? 1 : 0;
    EXPECT_EQ(table.find("heat.probes.top.temperature")->numbers[i], summary["heat"]["probes"]["top"]["temperature"]);
    const auto probes = output::read_probe_history(study.out / table.find("directory")->texts[i] / "probes.csv");
    const double warm = table.find("warm")->numbers[i];
    const auto after =
        static_cast<std::size_t>(std::upper_bound(probes.times.begin(), probes.times.end(), warm) - probes.times.begin());
    EXPECT_GE(probes.values.at("top").at(after), 350);
    EXPECT_LE(probes.values.at("top").at(after - 1), 350);
  }
  EXPECT_EQ(settled, 2);
  EXPECT_GT(table.find("warm")->numbers[0], table.find("warm")->numbers[2]) << "a weaker joint heats later";
  const study::Table means = study::read_table(study.out / "ensembles.h5");
  EXPECT_DOUBLE_EQ(means.find("warm.mean")->numbers[0], (table.find("warm")->numbers[0] + table.find("warm")->numbers[1]) / 2);
}

TEST(StudyCommand, GivesTheResultsOfSingleRuns) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run().status, 0);
  const fs::path alone = study.file.parent_path() / "alone";
  const Ended ended = shell(std::string(SCREE_PROGRAM) + " run " + (study.file.parent_path() / "scene.yaml").string() +
                                " --quiet --out " + alone.string() + " --set contact.stiffness_factor=100 --set settle.seed=2",
                            study.file.parent_path());
  ASSERT_EQ(ended.status, 0) << ended.text;
  EXPECT_EQ(contents(alone / "probes.csv"), contents(study.out / study.table().find("directory")->texts[3] / "probes.csv"));
}

TEST(StudyCommand, ARunThatIsRefusedLeavesThePackingToTheNext) {
  const OneStudy study(R"(
scene: scene.yaml
vary: [{key: "heat.boundaries[0].surface", values: [no_such, z_low]}]
report: [heat.probes.top.temperature]
)");
  ASSERT_EQ(study.run().status, 1);
  EXPECT_THAT(study.table().find("status")->texts, testing::ElementsAre("bad_input", "complete"));
}

TEST(StudyCommand, MakesNothingTwice) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run().status, 0);
  const std::string before = contents(study.out / "table.csv");
  ASSERT_EQ(study.run().status, 0);
  EXPECT_EQ(contents(study.out / "table.csv"), before) << "the same wall times: no run was started";
}

TEST(StudyCommand, GoesOnWhereItWasKilled) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run("--task 1").status, 0);
  // The second run as a kill in its heat leaves it: a summary that says running, a packing, no end.
  ASSERT_EQ(study.run("--task 2").status, 0);
  ASSERT_EQ(study.run("--gather").status, 1) << "two runs are not made";
  const fs::path second = study.out / study.table().find("directory")->texts[1];
  nlohmann::json summary = study.summary(1);
  summary["status"] = "running";
  std::ofstream(second / "summary.json") << summary.dump();
  fs::remove(second / "outcome.json");
  const auto first_made = fs::last_write_time(study.out / study.table().find("directory")->texts[0] / "summary.json");
  ASSERT_EQ(study.run().status, 0);
  EXPECT_THAT(study.table().find("status")->texts, Each("complete"));
  EXPECT_EQ(fs::last_write_time(study.out / study.table().find("directory")->texts[0] / "summary.json"), first_made);
}

TEST(StudyCommand, BeginsARunAnewThatCannotBeGoneOnWith) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run("--task 1").status, 0);
  ASSERT_EQ(study.run("--gather").status, 1) << "three runs are not made";
  const fs::path first = study.out / study.table().find("directory")->texts[0];
  const std::string probes = contents(first / "probes.csv");
  nlohmann::json summary = study.summary(0);
  summary["status"] = "interrupted";
  std::ofstream(first / "summary.json") << summary.dump();
  std::ofstream(first / "heat.restart.h5") << "no state";
  const Ended ended = study.run("--task 1");
  ASSERT_EQ(ended.status, 0) << ended.text;
  EXPECT_EQ(contents(first / "probes.csv"), probes);
}

// Long enough that nobody ends it by accident.
std::string slow_study() {
  return std::string(two_by_two) + "set: [heat.until=40 h]\n";
}

// Starts the study in the background, and goes on with `next` when its first run is under way.
Ended while_it_runs(const OneStudy& study, const std::string& next) {
  const std::string first = (study.out / "runs").string() + "/*/scene.yaml";
  const std::string begun = fmt::format("until ls {} >/dev/null 2>&1 || ! kill -0 $study; do sleep 0.01; done", first);
  return shell(fmt::format("({} & study=$!; {}; {})", study.command("--jobs 1 --json"), begun, next), study.file.parent_path());
}

TEST(StudyCommand, StopsItsRunsWhenInterruptedAndGoesOnLater) {
  const OneStudy study(slow_study());
  const Ended ended = while_it_runs(study, "kill -TERM $study; wait $study");
  EXPECT_EQ(ended.status, 130) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr(R"("event":"end","status":"interrupted","exit_status":130)"));
  EXPECT_EQ(study.run().status, 0);
  EXPECT_THAT(study.table().find("status")->texts, Each("complete"));
}

TEST(StudyCommand, MakesNoRunOfASceneThatHasChangedSinceItWasPlanned) {
  const OneStudy study(slow_study());
  const fs::path scene = study.file.parent_path() / "scene.yaml";
  const std::string planned = contents(scene);
  const std::string change = fmt::format("sed -i 's/temperature: 400/temperature: 500/' {}", scene.string());
  const Ended ended = while_it_runs(study, change + "; wait $study");
  EXPECT_EQ(ended.status, 1) << ended.text;
  const study::Table table = study.table();
  EXPECT_THAT(table.find("status")->texts, testing::ElementsAre("complete", "crashed", "crashed", "crashed"));
  EXPECT_THAT(table.find("reason")->texts[3], HasSubstr("has changed since this run was planned"));
  std::ofstream(scene) << planned;
  EXPECT_EQ(study.run().status, 0);
  EXPECT_THAT(study.table().find("status")->texts, Each("complete"));
}

TEST(StudyCommand, RecordsARunThatFailsWithItsReasonAndMakesTheOthers) {
  const OneStudy study(R"(
scene: scene.yaml
vary: [{key: settle.limit, values: [5 s, 0.25 s]}, {key: heat.until, values: [1 h, 2 h]}]
report: [heat.time]
)");
  EXPECT_EQ(study.run().status, 1);
  const study::Table table = study.table();
  EXPECT_THAT(table.find("status")->texts, testing::ElementsAre("complete", "complete", "not_settled", "not_settled"));
  EXPECT_THAT(table.find("reason")->texts[2], HasSubstr("still moving"));
  EXPECT_THAT(table.find("heat.time")->numbers, testing::ElementsAre(3600, 7200, testing::IsNan(), testing::IsNan()));
}

TEST(StudyCommand, RecordsARunThatTheSystemKillsAndMakesTheOthersAndLaterThatOne) {
  const OneStudy study(slow_study());
  const Ended ended = while_it_runs(study, "kill -KILL $(cat /proc/$study/task/$study/children); wait $study");
  EXPECT_EQ(ended.status, 1) << ended.text;
  study::Table table = study.table();
  EXPECT_THAT(table.find("status")->texts, testing::ElementsAre("crashed", "complete", "complete", "complete"));
  EXPECT_THAT(table.find("reason")->texts[0], HasSubstr("ended by signal 9"));
  EXPECT_EQ(study.run().status, 0);
  EXPECT_THAT(study.table().find("status")->texts, Each("complete"));
}

// A body whose mesh file is not closed fails in the mesher, before there is a packing.
TEST(StudyCommand, SaysOfEveryRunWhatIsWrongWithAPackingThatCannotBeMade) {
  const OneStudy study(R"(
scene: scene.yaml
set: ["bodies.block.box=null", "bodies.block.mesh.position=[0, 0, 0.1]", bodies.block.mesh.file=open.stl]
vary: [{key: heat.until, values: [1 h, 2 h]}]
report: [heat.time]
)");
  const fs::path open = study.file.parent_path() / "open.stl";
  std::ofstream(open)
      << "solid open\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
         "endsolid open\n";
  const Ended ended = study.run("--jobs 1");
  EXPECT_EQ(ended.status, 1) << ended.text;
  const study::Table table = study.table();
  EXPECT_THAT(table.find("status")->texts, Each("bad_input"));
  EXPECT_THAT(table.find("reason")->texts, Each(HasSubstr("open.stl")));
}

TEST(StudyCommand, RefusesWhatIsWrongBeforeAnyRun) {
  const OneStudy study("scene: scene.yaml\nvary: [{key: heat.tolerance, values: [1 K, 2 m]}]\nreport: [heat.time]\n");
  const Ended ended = study.run();
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.text, HasSubstr("heat.tolerance is 2 m"));
  EXPECT_FALSE(fs::exists(study.out));
  EXPECT_THAT(study.run("--json").text, HasSubstr(R"("status":"bad_input")"));
}

TEST(StudyCommand, NamesBareTemperaturesOfItsOwnOnce) {
  const OneStudy study(R"(
scene: scene.yaml
vary:
  - {key: heat.initial, range: {from: 20, to: 350 K, points: 2}}
  - {key: heat.until, values: [1 h, 2 h]}
report: [{column: when, probe: top, reaches: 70}]
)");
  const Ended ended = listed(study);
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.text,
              HasSubstr("suspicious: vary[0].range.from is 20, which is in kelvin: write 20 degC if that is meant"));
  EXPECT_THAT(ended.text, HasSubstr("suspicious: report[0].reaches is 70, which is in kelvin"));
  EXPECT_THAT(ended.text, Not(HasSubstr("range.to")));
}

TEST(StudyCommand, NamesABareTemperatureOfItsScenesOnceForAllRuns) {
  const OneStudy study(R"(
scene: scene.yaml
set: [heat.initial=25]
vary: [{key: heat.until, values: [1 h, 2 h]}]
report: [heat.time]
)");
  const Ended ended = listed(study);
  const std::string sentence = "suspicious: heat.initial is 25, which is in kelvin";
  ASSERT_THAT(ended.text, HasSubstr(sentence));
  EXPECT_EQ(ended.text.find(sentence, ended.text.find(sentence) + 1), std::string::npos);
}

TEST(StudyCommand, SaysThatEqualPointsOfALatinHypercubeAreMadeOnce) {
  const OneStudy study(R"(
scene: scene.yaml
vary: [{key: heat.until, values: [1 h, 2 h]}]
latin_hypercube: {points: 6}
report: [heat.time]
)");
  const Ended ended = listed(study);
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.text, HasSubstr("2 runs instead of 6"));
  EXPECT_EQ(study.run().status, 0);
  EXPECT_EQ(study.table().rows(), 2u);
}

TEST(StudyCommand, SaysWhenAFigureIsInNoSummary) {
  const OneStudy study("scene: scene.yaml\nvary: [{key: heat.until, values: [1 h]}]\nreport: [heat.tme]\n");
  const Ended ended = study.run();
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.text, HasSubstr("s.yaml:3:10: report: heat.tme is in no summary.json. Did you mean heat.time?"));
}

TEST(StudyCommand, TabulatesTheOthersWhereARunHasLostItsProbes) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run().status, 0);
  const study::Table whole = study.table();
  const std::string& lost = whole.find("directory")->texts[1];
  fs::remove(study.out / lost / "probes.csv");
  EXPECT_EQ(study.run("--gather").status, 1);
  const study::Table table = study.table();
  EXPECT_THAT(table.find("status")->texts, testing::ElementsAre("complete", "damaged", "complete", "complete"));
  EXPECT_THAT(table.find("reason")->texts[1], testing::AllOf(HasSubstr("probes.csv"), HasSubstr("Remove " + lost)));
  EXPECT_TRUE(std::isnan(table.find("warm")->numbers[1]));
  EXPECT_EQ(table.find("warm")->numbers[0], whole.find("warm")->numbers[0]);
  fs::remove_all(study.out / lost);
  EXPECT_EQ(study.run().status, 0);
  EXPECT_EQ(study.table().find("warm")->numbers, whole.find("warm")->numbers);
}

TEST(StudyCommand, MakesItsRunsAsTasksAtOnceWithTheSamePackings) {
  const OneStudy study(two_by_two);
  std::string tasks;
  for (int i = 1; i <= 4; ++i) tasks += fmt::format("{} & ", study.command(fmt::format("--task {}", i)));
  shell(fmt::format("({} wait)", tasks), study.file.parent_path());
  EXPECT_EQ(study.run("--gather").status, 0);
  const study::Table table = study.table();
  EXPECT_THAT(table.find("status")->texts, Each("complete"));
  int settled = 0;
  for (std::size_t i = 0; i < 4; ++i) settled += settled_here(study.summary(i)) ? 1 : 0;
  EXPECT_EQ(settled, 2);
}

TEST(StudyCommand, IsNotMadeTwiceAtATimeInOneFolder) {
  const OneStudy study(slow_study());
  const Ended ended = while_it_runs(study, study.command("") + "; echo second $?; kill -TERM $study; wait");
  EXPECT_THAT(ended.text, AllOf(HasSubstr("at work there"), HasSubstr("second 1")));
}

// A kill of the study leaves its run at work, which then holds the lock.
TEST(StudyCommand, WaitsForRunsThatAKilledStudyHasLeftBehind) {
  const OneStudy study(slow_study());
  const Ended ended = while_it_runs(study, "kill -KILL $study; wait $study; " + study.command("") + "; echo second $?");
  EXPECT_THAT(ended.text, AllOf(HasSubstr("at work there"), HasSubstr("second 1")));
  int status = 1;
  for (int i = 0; i < 300 && status != 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    status = study.run().status;
  }
  EXPECT_EQ(status, 0);
}

TEST(StudyCommand, KeepsThePackingAndTheTimeOfARunThatAKilledStudyHasLeftBehind) {
  const OneStudy study(slow_study());
  while_it_runs(study, "kill -KILL $study; wait $study");
  int status = 1;
  for (int i = 0; i < 300 && status != 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    status = study.run().status;
  }
  ASSERT_EQ(status, 0);
  const study::Table table = study.table();
  const auto first = study.summary(0);
  double stages = 0;
  for (const auto& stage : first["stages"]) stages += stage["wall_seconds"].get<double>();
  EXPECT_FALSE(fs::exists(study.out / table.find("directory")->texts[0] / "outcome.json")) << "nobody saw it end";
  EXPECT_DOUBLE_EQ(table.find("wall_seconds")->numbers[0], stages);
  EXPECT_GT(stages, 0);
  int settled = 0;
  for (std::size_t i = 0; i < 4; ++i) settled += settled_here(study.summary(i)) ? 1 : 0;
  EXPECT_EQ(settled, 2) << "once per seed";
}

TEST(StudyCommand, TellsAProgramHowFarItIsAndHowItEnded) {
  const OneStudy study("scene: scene.yaml\nvary: [{key: heat.until, values: [1 h, 2 h]}]\nreport: [heat.time]\n");
  const Ended ended = shell(fmt::format("{} study {} --json --out {}", SCREE_PROGRAM, study.file.string(), study.out.string()),
                            study.file.parent_path());
  ASSERT_EQ(ended.status, 0) << ended.text;
  std::istringstream lines(ended.text);
  std::vector<nlohmann::json> events;
  SCOPED_TRACE(ended.text);
  for (std::string line; std::getline(lines, line);) events.push_back(nlohmann::json::parse(line));
  EXPECT_EQ(events.front()["event"], "start");
  EXPECT_EQ(events.back()["event"], "end");
  EXPECT_EQ(events.back()["status"], "complete");
  EXPECT_EQ(events.back()["directory"], study.out.string());
}

TEST(StudyCommand, FindsNothingWrongWithTheStudiesThatAreShipped) {
  const fs::path folder = study_file("", "").parent_path();
  for (const auto& entry : fs::directory_iterator(fs::path(SCREE_SOURCE_DIR) / "scenes/studies")) {
    const Ended ended = shell(std::string(SCREE_PROGRAM) + " study --list " + entry.path().string(), folder);
    EXPECT_EQ(ended.status, 0) << entry.path() << ended.text;
    EXPECT_GT(std::count(ended.text.begin(), ended.text.end(), '\n'), 1);
  }
}

TEST(StudyCommand, DrawsItsTable) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run().status, 0);
  const Ended ended =
      shell(std::string(SCREE_PROGRAM) + " plot " + study.out.string() + " --x contact.stiffness_factor --y warm --log x",
            study.file.parent_path());
  EXPECT_EQ(ended.status, 0) << ended.text;
  EXPECT_GT(fs::file_size(study.out / "warm.png"), 5000u);
  // Neither the user's own settings of gnuplot nor a full disk, of which gnuplot says nothing.
  std::ofstream(study.file.parent_path() / ".gnuplot") << "exit status 3\n";
  const fs::path again = study.file.parent_path() / "again.png";
  const std::string drawing = std::string(SCREE_PROGRAM) + " plot " + study.out.string() +
                              " --x contact.stiffness_factor --y warm --picture " + again.string();
  EXPECT_EQ(shell("HOME=" + study.file.parent_path().string() + " " + drawing, study.file.parent_path()).status, 0);
  ASSERT_TRUE(fs::remove(again));
  EXPECT_EQ(shell("trap '' XFSZ; ulimit -f 8; " + drawing, study.file.parent_path()).status, 1);
  EXPECT_FALSE(fs::exists(again));
  // What gnuplot would take for a command, an escape or the end of a text is a part of it.
  const fs::path odd = study.file.parent_path() / "a `touch run`, \"b\\n'c.png";
  std::ofstream(study.file.parent_path() / "plot.sh")
      << SCREE_PROGRAM << " plot " << study.out.string()
      << " --x contact.stiffness_factor --y warm --x-label 'x `touch run`' --picture "
      << R"sh("a \`touch run\`, \"b\\n'c.png")sh";
  const Ended drawn = shell("cd " + study.file.parent_path().string() + " && sh plot.sh", study.file.parent_path());
  EXPECT_EQ(drawn.status, 0) << drawn.text;
  EXPECT_TRUE(fs::exists(odd));
  EXPECT_FALSE(fs::exists(study.file.parent_path() / "run"));
  EXPECT_EQ(shell(std::string(SCREE_PROGRAM) + " plot " + study.out.string() +
                      " --x contact.stiffness_factor --y warm --picture nowhere/x.png",
                  study.file.parent_path())
                .status,
            2);
}

}  // namespace
}  // namespace scree::test
