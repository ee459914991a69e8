// The page of a run, as a browser shows it.

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/scenes/scene_run.h"
#include "tests/temp_folder.h"
#include "tools/report/report_command.h"

namespace scree::report {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

bool have(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
}

// Pixels of one kind of colour and their mean row, counted from the top.
struct Patch {
  int pixels = 0;
  double row = 0;
};

template <class IsWanted>
Patch find_pixels(const std::string& rgb, const IsWanted& is_wanted) {
  Patch patch;
  const auto at = [&](std::size_t i) { return static_cast<int>(static_cast<unsigned char>(rgb[i])); };
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    if (!is_wanted(at(i), at(i + 1), at(i + 2))) continue;
    ++patch.pixels;
    patch.row += static_cast<double>(i / 3000);
  }
  patch.row /= std::max(1, patch.pixels);
  return patch;
}

class ReportInABrowser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = new test::SceneRun(test::run("small_pile", test::fresh_directory("report"), {"heat.until=20 min"}));
    std::filesystem::create_directory(run_->directory / "work");
    if (have("Xvfb")) write();
  }
  static void TearDownTestSuite() { delete run_; }

  void SetUp() override {
    if (!have("Xvfb")) GTEST_SKIP() << "Xvfb is not installed (tools/setup installs it)";
  }

  static std::string write() {
    ReportArguments arguments;
    arguments.directory = run_->directory.string();
    report_command(arguments);
    return test::contents(page());
  }
  static std::filesystem::path page() { return run_->directory / "report.html"; }

  // Chromium without a screen and with no host to be reached; its own files go into the test's directory.
  static int chromium(const std::string& what) {
    const std::string home = (run_->directory / "work").string();
    return std::system(("HOME=" + home +
                        " timeout 60 chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars "
                        "--host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir=" +
                        home + "/profile " + what + " file://" + page().string() + " 2> " + home + "/log")
                           .c_str());
  }

  // The pixels of a picture, row by row from the top.
  static std::string rgb(const std::filesystem::path& png) {
    const std::filesystem::path raw = png.string() + ".rgb";
    const std::string command = "ffmpeg -loglevel error -y -i " + png.string() + " -f rawvideo -pix_fmt rgb24 " + raw.string();
    return std::system(command.c_str()) == 0 ? test::contents(raw) : "";
  }

  static constexpr std::size_t columns = 1000;
  static constexpr std::size_t rows = 4600;
  static test::SceneRun* run_;
};

test::SceneRun* ReportInABrowser::run_ = nullptr;

TEST_F(ReportInABrowser, ThePageHoldsEverySectionAndNeedsNothingFromElsewhere) {
  const std::string html = test::contents(page());
  for (const char* heading : {"What was modelled, and why", "Pictures", "Temperature at the probes", "Settling certificate",
                              "Energy ledger", "Errors", "Joints", "Cost of the stages"}) {
    EXPECT_THAT(html, HasSubstr(std::string("<h2>") + heading + "</h2>"));
  }
  EXPECT_THAT(html, Not(ContainsRegex("(src|href)=\"[^d]")));  // only data: URLs
  EXPECT_THAT(html, HasSubstr(run_->summary["settle"]["certificate"]["packing_hash"].get<std::string>()));
}

TEST_F(ReportInABrowser, TheSameRunGivesTheSamePage) {
  const std::string first = test::contents(page());
  EXPECT_EQ(write(), first);
}

TEST_F(ReportInABrowser, ChromiumShowsTheHotPileTheCurveAndTheTables) {
  if (!have("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed (tools/setup installs it)";
  if (!have("chromium")) GTEST_SKIP() << "chromium is not installed (apt-get install chromium to try the page in a browser)";
  const std::filesystem::path dom = run_->directory / "work" / "dom.html";
  ASSERT_EQ(chromium("--dump-dom > " + dom.string() + " --window-size=1000,800"), 0);
  EXPECT_THAT(test::contents(dom), HasSubstr("<polyline fill=\"none\""));
  const std::filesystem::path png = run_->directory / "work" / "screen.png";
  ASSERT_EQ(chromium(fmt::format("--window-size={},{} --screenshot=", columns, rows) + png.string()), 0);
  const std::string pixels = rgb(png);
  ASSERT_EQ(pixels.size(), 3U * columns * rows);
  const Patch hot = find_pixels(pixels, [](int r, int g, int b) { return r > b + 60 && r > g + 20; });
  const Patch cold = find_pixels(pixels, [](int r, int, int b) { return b > r + 40; });
  const Patch curve = find_pixels(pixels, [](int r, int g, int b) { return r == 0xd5 && g == 0x5e && b == 0; });
  const Patch dark = find_pixels(pixels, [](int r, int g, int b) { return r + g + b < 150; });
  EXPECT_GT(hot.pixels, 20000);   // the plate and the foot of the pile, twice
  EXPECT_GT(cold.pixels, 20000);  // its top, twice
  EXPECT_GT(curve.pixels, 300);
  EXPECT_GT(curve.row, hot.row);  // below the pictures
  EXPECT_GT(dark.pixels, 20000);  // text
}

TEST_F(ReportInABrowser, ADamagedPackingIsSaidInsteadOfAPictureLeftOut) {
  const test::TempFolder folder;
  std::filesystem::copy(run_->directory, folder.path() / "run", std::filesystem::copy_options::recursive);
  std::filesystem::resize_file(folder.path() / "run" / "packing.h5", 1000);
  ReportArguments arguments;
  arguments.directory = (folder.path() / "run").string();
  arguments.page = (folder.path() / "page.html").string();
  EXPECT_THROW(report_command(arguments), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page.html"));
}

TEST_F(ReportInABrowser, WhatIsNoRunIsRefused) {
  ReportArguments arguments;
  arguments.directory = (run_->directory / "work").string();
  EXPECT_THROW(report_command(arguments), InputError);
}

}  // namespace
}  // namespace scree::report
