// What a study makes of runs that are not as it left them.
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/study/one_study.h"
#include "tests/study/study_text.h"

namespace scree::test {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::HasSubstr;

fs::path folder_of(const OneStudy& study, std::size_t row) {
  return study.out / study.table().find("directory")->texts[row];
}

TEST(StudyDamage, OfAProbeTableIsSaidOfItsRunAlone) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run().status, 0);
  const fs::path probes = folder_of(study, 1) / "probes.csv";
  const std::string whole = contents(probes);
  const std::string last = whole.substr(whole.rfind('\n', whole.size() - 2) + 1);
  const std::string cut = whole.substr(0, whole.size() - last.size());
  for (const std::string& damaged : {cut, std::string(), cut + "xx\n", cut + "xx" + last}) {
    std::ofstream(probes) << damaged;
    EXPECT_EQ(study.run("--gather").status, 1);
    const study::Table table = study.table();
    EXPECT_THAT(table.find("status")->texts, testing::ElementsAre("complete", "damaged", "complete", "complete"));
    EXPECT_THAT(table.find("reason")->texts[1], HasSubstr("probes.csv"));
  }
  fs::remove(probes);
  fs::create_directory(probes);
  EXPECT_EQ(study.run("--gather").status, 1);
  EXPECT_EQ(study.table().find("status")->texts[1], "damaged");
}

TEST(StudyDamage, OfWhatARunWouldGoOnFromHasItBegunAnew) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run("--task 1").status, 0);
  ASSERT_EQ(study.run("--gather").status, 1) << "three runs are not made";
  const fs::path first = folder_of(study, 0);
  const std::string probes = contents(first / "probes.csv");
  for (const char* lost : {"heat.pvd", "probes.csv"}) {
    nlohmann::json summary = nlohmann::json::parse(contents(first / "summary.json"));
    summary["status"] = "interrupted";
    std::ofstream(first / "summary.json") << summary.dump();
    fs::remove(first / lost);
    const Ended ended = study.run("--task 1");
    ASSERT_EQ(ended.status, 0) << lost << ": " << ended.text;
    EXPECT_EQ(contents(first / "probes.csv"), probes) << lost;
  }
}

TEST(StudyDamage, IsNoneOfAnEnsembleThatTheStudyHasNoMore) {
  const OneStudy study(two_by_two);
  ASSERT_EQ(study.run().status, 0);
  ASSERT_TRUE(fs::exists(study.out / "ensembles.csv"));
  std::string text = two_by_two;
  text.erase(text.find("ensemble:"), text.find("report:") - text.find("ensemble:"));
  std::ofstream(study.file) << text;
  ASSERT_EQ(study.run().status, 0);
  for (const char* earlier : {"ensembles.csv", "ensembles.h5"}) EXPECT_FALSE(fs::exists(study.out / earlier)) << earlier;
}

TEST(StudyDamage, IsNotDoneToAPathThatYamlTakesForSomethingElse) {
  const fs::path plain = study_file(falling_scene, "{}").parent_path();
  const fs::path odd = plain.parent_path() / (plain.filename().string() + " #3: x");
  fs::remove_all(odd);
  fs::copy(plain, odd, fs::copy_options::recursive);
  const std::string in_odd = fmt::format("cd '{}' && {} ", odd.string(), SCREE_PROGRAM);
  ASSERT_EQ(shell(in_odd + "run scene.yaml --out once --quiet", plain).status, 0);
  std::ofstream(odd / "study.yaml") << "scene: scene.yaml\nset: [settle=null, packing=once/packing.h5]\n"
                                       "vary: [{key: contact.stiffness_factor, values: [1, 100]}]\n"
                                       "report: [heat.probes.top.temperature]\n";
  const Ended ended = shell(in_odd + "study study.yaml --threads 1 --quiet", plain);
  EXPECT_EQ(ended.status, 0) << ended.text;
}

}  // namespace
}  // namespace scree::test
