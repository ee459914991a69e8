// The page of a run without its pictures.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/scenes/scene_run.h"
#include "tools/report/run_report.h"

namespace scree::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(RunPage, TellsWhatToKnowBeforeUsingTheResultsAndNothingIfThereIsNothing) {
  const std::string heading = "<h2>To know before using it</h2>";
  const auto plain = test::run("hexahedra", test::fresh_directory("page_plain"));
  EXPECT_THAT(run_page(run::RunFiles{plain.directory}, Pictures::none), Not(HasSubstr(heading)));
  const auto bare = test::run("hexahedra", test::fresh_directory("page_bare"), {"heat.initial=25"});
  const std::string html = run_page(run::RunFiles{bare.directory}, Pictures::none);
  EXPECT_THAT(html, HasSubstr(heading + "\n<p>suspicious: heat.initial is 25, which is in kelvin"));
}

TEST(RunPage, RefusesASummaryThatNoRunHasLeft) {
  const auto directory = test::fresh_directory("page_of_no_run");
  for (const char* summary : {R"({"status": "complete", "models": [], "heat": {}})", R"({"status": 1})",
                              R"({"status": "complete", "settle": {"certificate": {}}})", R"({"status": "complete"})"}) {
    std::ofstream(directory / "summary.json") << summary;
    EXPECT_THROW(run_page(run::RunFiles{directory}, Pictures::none), InputError) << summary;
  }
}

TEST(RunPage, RefusesProbesThatEndBeforeTheirRunDid) {
  const auto run = test::run("hexahedra", test::fresh_directory("page_of_cut_probes"));
  const run::RunFiles files{run.directory};
  EXPECT_THAT(run_page(files, Pictures::none), HasSubstr("Temperature at the probes"));
  std::filesystem::resize_file(files.probes(), std::filesystem::file_size(files.probes()) / 2);
  EXPECT_THAT([&] { run_page(files, Pictures::none); },
              testing::ThrowsMessage<RunError>(HasSubstr("probes.csv: is damaged: it ends before its run did")));
}

}  // namespace
}  // namespace scree::report
