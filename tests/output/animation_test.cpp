// Videos of a series, and contacts as lines.

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/output/render.h"
#include "tests/file_limit.h"
#include "tests/output/pixels.h"
#include "tests/output/synthetic_pile.h"

namespace scree::output {
namespace {

using ::testing::HasSubstr;

bool have(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
}

bool is_cold(int r, int, int b) {
  return b > r + 20;
}
bool is_hot(int r, int, int b) {
  return r > b + 60;
}

class AnimationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!have("Xvfb")) GTEST_SKIP() << "Xvfb is not installed (tools/setup installs it)";
    if (!have("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed (tools/setup installs it)";
    const auto mesh = synthetic_pile(100, 4);
    Series series(folder_.path(), "heat");
    Frame cold = warmed_from_below(mesh, 60);
    std::get<std::vector<double>>(cold.points[0].values).assign(mesh.nodes.size(), 298.15);
    series.write(make_grid(mesh), cold);
    series.write(make_grid(mesh), warmed_from_below(mesh, 36000));
    picture_.series = folder_.path() / "heat.pvd";
    picture_.array = "temperature";
    picture_.width = 360;
    picture_.height = 240;
  }

  // Frame `number` of a video as a picture.
  std::filesystem::path frame(const std::filesystem::path& video, int number) {
    const std::filesystem::path png = folder_.path() / ("frame" + std::to_string(number) + ".png");
    const std::string command = "ffmpeg -loglevel error -y -i " + video.string() + " -vf 'select=eq(n\\," +
                                std::to_string(number) + ")' -frames:v 1 " + png.string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    return png;
  }

  static constexpr int scene_columns = 290;  // left of the legend
  TempFolder folder_;
  Picture picture_;
};

TEST_F(AnimationTest, TheHeapIsColdInTheFirstFrameAndHotBelowInTheLastOnOneScale) {
  for (const char* name : {"heat.webm", "heat.mp4"}) {
    const auto video = folder_.path() / name;
    animate(picture_, {1, {}}, video);
    EXPECT_LT(find_pixels(frame(video, 0), scene_columns, is_hot).pixels, 50) << name;
    EXPECT_GT(find_pixels(frame(video, 0), scene_columns, is_cold).pixels, 4000) << name;
    const Patch hot = find_pixels(frame(video, 1), scene_columns, is_hot);
    EXPECT_GT(hot.pixels, 3000) << name;
    EXPECT_GT(find_pixels(frame(video, 1), scene_columns, is_cold).row, hot.row + 20) << name;
  }
}

TEST_F(AnimationTest, FailsOnAFullDiskAndLeavesNothing) {
  for (const char* name : {"heat.webm", "heat.mp4"}) {
    const auto video = folder_.path() / name;
    animate(picture_, {1, {}}, video);
    const auto whole = std::filesystem::file_size(video);
    std::filesystem::remove(video);
    for (const std::size_t room : {whole / 2, whole - 1}) {
      const test::FileLimit full(room);
      EXPECT_THROW(animate(picture_, {1, {}}, video), RunError) << name << room;
      EXPECT_FALSE(std::filesystem::exists(video)) << name << room;
    }
  }
}

TEST_F(AnimationTest, LastsAsLongAsAskedForAndIsNoSlideShowUnlessAsked) {
  const auto seconds = [&](const std::optional<double>& duration, const char* name) {
    const auto video = folder_.path() / name;
    const auto said = folder_.path() / "seconds";
    animate(picture_, {duration, {}}, video);
    const std::string command = "ffprobe -v error -show_entries format=duration -of csv=p=0 " + video.string();
    EXPECT_EQ(std::system((command + " > " + said.string()).c_str()), 0);
    return std::stod(content(said));
  };
  for (const char* name : {"heat.webm", "heat.mp4"}) {
    EXPECT_NEAR(seconds(30, name), 30, 0.01) << name;
    EXPECT_NEAR(seconds(0.5, name), 0.5, 0.01) << name;
    EXPECT_NEAR(seconds(std::nullopt, name), 1, 0.01) << name << ": two frames";
  }
}

TEST_F(AnimationTest, LeavesNothingWhenStoppedOnItsWay) {
  struct Stopped {};
  for (const int last : {1, 3, 4}) {
    int frames = 0;
    const auto stop = [&] {
      if (++frames == last) throw Stopped{};
    };
    EXPECT_THROW(animate(picture_, {1, stop}, folder_.path() / "stopped.mp4"), Stopped);
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.path().filename().string().find("stopped"), std::string::npos) << entry.path();
  }
}

TEST_F(AnimationTest, TheSameSeriesGivesTheSameBytes) {
  animate(picture_, {1, {}}, folder_.path() / "a.webm");
  animate(picture_, {1, {}}, folder_.path() / "b.webm");
  EXPECT_EQ(content(folder_.path() / "a.webm"), content(folder_.path() / "b.webm"));
}

TEST_F(AnimationTest, AnotherKindOfFileOrNoFfmpegIsAnErrorAndLeavesNoFile) {
  EXPECT_THROW(animate(picture_, {1, {}}, folder_.path() / "heat.gif"), InputError);
  const std::string path = std::getenv("PATH");
  const auto only = folder_.path() / "bin";
  std::filesystem::create_directory(only);
  std::filesystem::create_symlink("/usr/bin/Xvfb", only / "Xvfb");
  ::setenv("PATH", only.c_str(), 1);
  try {
    animate(picture_, {1, {}}, folder_.path() / "heat.webm");
    ADD_FAILURE();
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), HasSubstr("apt-get install ffmpeg"));
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "heat.webm"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "heat.gif"));
}

// Two pairs of triangles side by side; a contact in each pair, of which the right one carries the heat, against its direction.
TEST_F(AnimationTest, ContactLinesAreHotWhereTheHeatFlows) {
  mesh::BlockMesh<2> mesh;
  mesh.bodies.push_back({"bar", MaterialId{0}, false, {}});
  for (const double x : {0.0, 2.0}) {
    for (const double y : {0.0, 1.0}) {
      add_block<2>(mesh, BodyId{0}, {Point<2>(x, y), Point<2>(x + 1, y), Point<2>(x, y + 1)});
    }
  }
  const auto folder = folder_.path() / "run";
  std::filesystem::create_directory(folder);
  Series blocks(folder, "heat");
  blocks.write(make_grid(mesh), {7, {}, {{"block", 1, std::vector<std::int32_t>{0, 1, 2, 3}}}});
  Series contacts(folder, "contacts");
  Grid points;
  points.points = {{0.2, 1, 0}, {2.2, 1, 0}};
  points.types = {CellType::vertex, CellType::vertex};
  points.connectivity = {0, 1};
  contacts.write(points, {7,
                          {},
                          {{"heat_flow", 1, std::vector<float>{0.1F, -10}},
                           {"owner", 1, std::vector<std::int32_t>{0, 2}},
                           {"target", 1, std::vector<std::int32_t>{1, 3}}}});
  picture_.series = folder / "contacts.pvd";
  picture_.array = "heat_flow";
  picture_.lines = true;
  picture_.range = {{0, 12.5}};
  const auto png = folder_.path() / "lines.png";
  render(picture_, png);
  const Patch cold = find_pixels(png, scene_columns, is_cold);
  const Patch hot = find_pixels(png, scene_columns, is_hot);
  EXPECT_GT(cold.pixels, 50);
  EXPECT_GT(hot.pixels, 50);
  EXPECT_GT(hot.column, cold.column + 100);
}

}  // namespace
}  // namespace scree::output
