#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/scenes/scene_run.h"
#include "tools/report/study_report.h"

namespace scree::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(StudyPage, ShowsEveryRunAndEachFigureAgainstTheKeyThatVaries) {
  const auto directory = test::fresh_directory("study_page");
  std::ofstream(directory / "table.csv") << "run,point,contact.stiffness_factor,high,status,reason\n"
                                            "aa,0,1,40.9,complete,\n"
                                            "bb,1,10,60.82,complete,\n"
                                            "cc,2,100,,failed,\"no space, it \"\"says\"\" <here>\nand there\"\n";
  const std::string html = study_page(directory);
  EXPECT_THAT(html, HasSubstr("3 runs."));
  EXPECT_THAT(html, HasSubstr("<td>no space, it &quot;says&quot; &lt;here&gt;\nand there</td>"));
  EXPECT_THAT(html, HasSubstr("high against contact.stiffness_factor"));
  EXPECT_THAT(html, Not(HasSubstr("point against")));
  // Two of the three runs have the figure, and so two points.
  std::size_t circles = 0;
  for (std::size_t at = html.find("<circle"); at != std::string::npos; at = html.find("<circle", at + 1)) ++circles;
  EXPECT_EQ(circles, 2U);
}

TEST(StudyPage, AnEmptyTableIsRefused) {
  const auto directory = test::fresh_directory("study_page_empty");
  std::ofstream(directory / "table.csv") << "";
  EXPECT_THROW(study_page(directory), InputError);
}

}  // namespace
}  // namespace scree::report
