#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/temp_folder.h"
#include "tools/report/chart.h"
#include "tools/report/page.h"

namespace scree::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Page, NamesFromASceneCannotBecomeMarkup) {
  Page page("a <pile> & \"more\"");
  page.heading("<script>");
  page.folded("x", "</pre><b>");
  EXPECT_THAT(page.html(), HasSubstr("<h1>a &lt;pile&gt; &amp; &quot;more&quot;</h1>"));
  EXPECT_THAT(page.html(), Not(HasSubstr("<script>")));
  EXPECT_THAT(page.html(), Not(HasSubstr("</pre><b>")));
}

// RFC 4648, section 10.
TEST(Page, FilesAreEmbeddedInBase64) {
  const auto file = test::temp_folder() / "data";
  for (const auto& [bytes, text] : {std::pair("", ""),
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}}) {
    std::ofstream(file) << bytes;
    EXPECT_EQ(data_url(file, "text/plain"), std::string("data:text/plain;base64,") + text);
  }
  std::filesystem::remove(file);
  EXPECT_THROW(data_url(file, "text/plain"), RunError);
}

TEST(Page, FiguresHaveFourDigitsAndWholeNumbersAreWhole) {
  EXPECT_EQ(figure(7622), "7622");
  EXPECT_EQ(figure(0.0218437), "0.02184");
  EXPECT_EQ(figure(1.23456e-9), "1.235e-09");
  EXPECT_EQ(figure(-0.5), "-0.5");
}

TEST(Chart, TicksAreRoundAndEncloseTheValues) {
  EXPECT_THAT(ticks(0, 60), ElementsAre(0, 10, 20, 30, 40, 50, 60));
  EXPECT_THAT(ticks(-3, 7), ElementsAre(-4, -2, 0, 2, 4, 6, 8));
  EXPECT_THAT(ticks(0.31, 0.39), ElementsAre(testing::DoubleEq(0.3), testing::DoubleEq(0.32), testing::DoubleEq(0.34),
                                             testing::DoubleEq(0.36), testing::DoubleEq(0.38), testing::DoubleEq(0.4)));
  EXPECT_LE(ticks(5, 5).front(), 5);
  EXPECT_GT(ticks(5, 5).back(), 5);
  for (const double rounded : {0.2, 308.15, -7e9}) {
    const auto marks = ticks(rounded, rounded + std::abs(rounded) * 1e-15);
    EXPECT_THAT(marks, testing::SizeIs(testing::AllOf(testing::Ge(2), testing::Le(8)))) << rounded;
    EXPECT_LE(marks.front(), rounded);
    EXPECT_GT(marks.back(), rounded);
  }
}

TEST(Chart, ACurveRunsFromCornerToCornerOfItsAxes) {
  Chart chart;
  chart.curves = {{"rising", {0, 5, 10}, {0, 1, 2}}};
  const std::string svg = to_svg(chart);
  // The axes lie from 92 to 690 across and from 328 up to 14; 5 and 1 are in the middle.
  EXPECT_THAT(svg, HasSubstr("points=\"92.0,328.0 391.0,171.0 690.0,14.0 \""));
  chart.points = true;
  EXPECT_THAT(to_svg(chart), HasSubstr("<circle cx=\"391.0\" cy=\"171.0\""));
}

TEST(Chart, WhatIsNotANumberIsLeftOut) {
  Chart chart;
  chart.curves = {{"broken", {0, 1, 2}, {1, std::nan(""), 3}}};
  EXPECT_THAT(to_svg(chart), Not(HasSubstr("nan")));
  chart.curves = {{"nothing", {}, {}}};
  EXPECT_EQ(to_svg(chart), "");
}

}  // namespace
}  // namespace scree::report
