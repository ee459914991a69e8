#include "engine/output/render.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/output/pixels.h"
#include "tests/output/synthetic_pile.h"

#ifdef __SANITIZE_ADDRESS__
// VTK 9.1's surface filter and Mesa's driver keep some memory to the end, and the driver is unloaded by then, so that nothing
// names it for a suppression.
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}  // NOLINT(bugprone-reserved-identifier)
#endif

namespace scree::output {
namespace {

using ::testing::HasSubstr;

class RenderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v Xvfb > /dev/null") != 0) GTEST_SKIP() << "Xvfb is not installed (tools/setup installs it)";
    const auto mesh = synthetic_pile(300, 6);
    Series series(folder_.path(), "heat");
    series.write(make_grid(mesh), warmed_from_below(mesh, 60));
    series.write(make_grid(mesh), warmed_from_below(mesh, 36000));
    picture_.series = folder_.path() / "heat.pvd";
    picture_.array = "temperature";
    picture_.range = {{298.15, 373.15}};
    picture_.width = 360;
    picture_.height = 240;
  }

  static constexpr int scene_columns = 290;  // left of the legend
  TempFolder folder_;
  std::filesystem::path png_ = folder_.path() / "picture.png";
  Picture picture_;
};

TEST_F(RenderTest, TheHeapIsColdOnTopAndHotBelowAndTheRestIsWhite) {
  for (const std::optional<double> cut : {std::optional<double>(), std::optional<double>(0)}) {
    picture_.cut = cut;
    render(picture_, png_);
    const Patch cold = find_pixels(png_, scene_columns, [](int r, int, int b) { return b > r + 20; });
    const Patch hot = find_pixels(png_, scene_columns, [](int r, int, int b) { return r > b + 60; });
    const Patch white = find_pixels(png_, scene_columns, [](int r, int g, int b) { return r + g + b == 3 * 255; });
    EXPECT_GT(cold.pixels, 300);
    EXPECT_GT(hot.pixels, 3000);
    EXPECT_GT(cold.row, hot.row + 20);
    EXPECT_GT(white.pixels, 10000);
  }
}

TEST_F(RenderTest, TheSamePictureTwiceIsTheSameToTheByte) {
  render(picture_, png_);
  const std::string first = content(png_);
  render(picture_, png_);
  EXPECT_EQ(content(png_), first);
}

TEST_F(RenderTest, DrawsTheNearestFrameAndLeavesTheCallersDisplayAsItWas) {
  ::setenv("DISPLAY", ":none", 1);
  render(picture_, png_);
  const std::string last = content(png_);
  picture_.time = 100;
  render(picture_, png_);
  EXPECT_NE(content(png_), last);
  picture_.time = 30000;
  render(picture_, png_);
  EXPECT_EQ(content(png_), last);
  EXPECT_STREQ(std::getenv("DISPLAY"), ":none");
}

TEST_F(RenderTest, ATimeBeyondTheSeriesIsAnError) {
  for (const double time : {-1e9, 1e9}) {
    picture_.time = time;
    EXPECT_THROW(render(picture_, png_), InputError);
  }
  EXPECT_FALSE(std::filesystem::exists(png_));
}

TEST_F(RenderTest, BodiesGetAColourEach) {
  picture_.array = "body";
  render(picture_, png_);
  const Patch plate = find_pixels(png_, picture_.width, [](int r, int g, int) { return g > r + 20; });
  const Patch rocks = find_pixels(png_, picture_.width, [](int r, int g, int) { return r > g + 40; });
  EXPECT_GT(plate.pixels, 5000);
  EXPECT_GT(rocks.pixels, 1000);
}

TEST_F(RenderTest, FlatDataIsSeenFromTheFront) {
  mesh::BlockMesh<2> mesh;
  mesh.bodies.push_back({"bar", MaterialId{0}, false, {}});
  add_block<2>(mesh, BodyId{0}, {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1)});
  Series series(folder_.path(), "flat");
  series.write(make_grid(mesh), {0, {{"temperature", 1, std::vector<double>{373.15, 373.15, 298.15}}}, {}});
  picture_.series = folder_.path() / "flat.pvd";
  render(picture_, png_);
  const Patch cold = find_pixels(png_, scene_columns, [](int r, int, int b) { return b > r + 20; });
  const Patch hot = find_pixels(png_, scene_columns, [](int r, int, int b) { return r > b + 60; });
  EXPECT_GT(hot.pixels, 5000);
  EXPECT_GT(cold.row, hot.row + 40);
}

TEST_F(RenderTest, AnUnknownArrayIsAnErrorThatListsTheKnownOnes) {
  picture_.array = "heat";
  try {
    render(picture_, png_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "array is heat (must be one of temperature, body)");
  }
}

TEST_F(RenderTest, WithoutXvfbTheErrorSaysWhatToInstall) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  try {
    render(picture_, png_);
    ADD_FAILURE();
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), HasSubstr("apt-get install xvfb"));
  }
  ::setenv("PATH", path.c_str(), 1);
}

TEST_F(RenderTest, AMissingSeriesOrAnEmptyViewIsAnError) {
  picture_.view = Aabb<3>(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
  EXPECT_THROW(render(picture_, png_), RunError);
  picture_.series = folder_.path() / "none.pvd";
  EXPECT_THROW(render(picture_, png_), RunError);
  EXPECT_FALSE(std::filesystem::exists(png_));
}

}  // namespace
}  // namespace scree::output
