// The scripts that hand a study's runs to what clusters run already.
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/study/one_study.h"

namespace scree::test {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::HasSubstr;

TEST(StudyBatch, WritesAScriptForGnuParallelThatMakesAndGathersItsRuns) {
  if (std::system("command -v parallel > /dev/null") != 0)
    GTEST_SKIP() << "GNU parallel is not there: apt-get install parallel";
  const OneStudy study(two_by_two);
  const std::string script = (study.file.parent_path() / "runs.sh").string();
  ASSERT_EQ(study.run("--parallel " + script).status, 0);
  const Ended ended = shell(script + " --jobs 2", study.file.parent_path());
  EXPECT_EQ(ended.status, 0) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("complete: " + study.out.string()));
  EXPECT_THAT(study.table().find("status")->texts, Each("complete"));
}

TEST(StudyBatch, WritesNoScriptThatGnuParallelWouldChange) {
  const OneStudy study(two_by_two);
  const Ended ended = shell(fmt::format("{} study {} --parallel runs.sh --out 'out {{.}}'", SCREE_PROGRAM, study.file.string()),
                            study.file.parent_path());
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.text, HasSubstr("must name no file with { in it"));
}

// What `sbatch` makes of an argument in a line of #SBATCH, as its source has it (_get_argument), and then of %% and %a in it.
std::string read_by_sbatch(const std::string& line, const std::string& task) {
  std::string argument;
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\') {
      argument += line[++i];
    } else if (quote == '\0' && (line[i] == '"' || line[i] == '\'')) {
      quote = line[i];
    } else if (line[i] == quote) {
      quote = '\0';
    } else {
      argument += line[i];
    }
  }
  std::string name;
  for (std::size_t i = 0; i < argument.size(); ++i) {
    if (argument[i] == '%') {
      name += argument[++i] == 'a' ? task : std::string(1, argument[i]);
    } else {
      name += argument[i];
    }
  }
  return name;
}

TEST(StudyBatch, WritesAJobArrayThatSlurmReadsWhateverTheFoldersAreCalled) {
  const OneStudy study(two_by_two);
  const fs::path odd = study.file.parent_path() / "50%a \"b\" $c 'd' #e";
  fs::create_directories(odd);
  for (const char* file : {"scene.yaml", "s.yaml"}) fs::copy_file(study.file.parent_path() / file, odd / file);
  const fs::path script = study.file.parent_path() / "job.sh";
  const auto in_odd = [&](const std::string& command) {
    std::ofstream(study.file.parent_path() / "do.sh") << "cd " << study.file.parent_path().string() << "/50*\n"
                                                      << command << "\n";
    return shell("sh " + (study.file.parent_path() / "do.sh").string(), study.file.parent_path());
  };
  const std::string program = SCREE_PROGRAM;
  ASSERT_EQ(in_odd(program + " study s.yaml --out out --slurm " + script.string()).status, 0);
  std::ifstream lines(script);
  std::string output;
  std::string gather;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#SBATCH --output=")) output = line.substr(std::string("#SBATCH --output=").size());
    if (line.find("--wrap") != std::string::npos) gather = line.substr(1);
  }
  EXPECT_EQ(read_by_sbatch(output, "7"), odd / "out/slurm-7.log");
  EXPECT_EQ(in_odd("SLURM_ARRAY_TASK_ID=1 " + script.string()).status, 0);
  // Slurm gives the last argument of this line to a shell.
  const Ended gathered = in_odd("sbatch() { for last; do :; done; sh -c \"$last\"; }\n" + gather);
  EXPECT_THAT(gathered.text, HasSubstr("1 of 4 runs complete"));
  EXPECT_TRUE(fs::exists(odd / "out/table.csv"));
  const Ended refused = in_odd(program + " study s.yaml --out 'a\\b' --slurm " + script.string());
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.text, HasSubstr("must name no file with a backslash"));
}

}  // namespace
}  // namespace scree::test
