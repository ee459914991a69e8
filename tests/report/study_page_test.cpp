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

// Two keys on a grid and a seed: one axis, one colour each for the second, and nothing drawn against the seed.
TEST(StudyPage, AGridIsDrawnWithAColourForEachValueOfItsSecondKey) {
  const auto directory = test::fresh_directory("study_page_grid");
  std::ofstream table(directory / "table.csv");
  table << "run,size,beta,seed,heat\n";
  int run = 0;
  for (const char* size : {"1", "2"}) {
    for (const char* beta : {"10", "100"}) {
      for (const char* seed : {"1", "2"}) {
        ++run;
        table << run << ',' << size << ',' << beta << ',' << seed << ',' << run * run << '\n';
      }
    }
  }
  table.close();
  const std::string html = study_page(directory);
  EXPECT_THAT(html, HasSubstr("heat against size, a colour for each beta"));
  EXPECT_THAT(html, Not(HasSubstr("seed against")));
  EXPECT_THAT(html, Not(HasSubstr("beta against")));
  EXPECT_THAT(html, HasSubstr(">100</text>"));
}

TEST(StudyPage, AnEmptyTableIsRefused) {
  const auto directory = test::fresh_directory("study_page_empty");
  std::ofstream(directory / "table.csv") << "";
  EXPECT_THROW(study_page(directory), InputError);
}

}  // namespace
}  // namespace scree::report
