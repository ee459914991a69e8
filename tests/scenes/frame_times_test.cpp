// Which outputs are frames.
#include "tools/run/frame_times.h"

#include <gtest/gtest.h>

#include "tools/scene/read_scene.h"

namespace scree::test {
namespace {

// Of outputs every third of a minute, to the digits that a scene gives, a frame every minute.
TEST(FrameTimes, AreEverySoManyOutputsWhateverTheDigitsOfTheInterval) {
  const auto file = std::filesystem::path(SCREE_SOURCE_DIR) / "scenes" / "bars_and_joint.yaml";
  for (const char* every : {"20 s", "0.3333333333 min"}) {
    const Scene scene = read_scene(file, {"heat.until=1 h", std::string("output.every=") + every, "output.frames_every=1 min"});
    const run::FrameTimes frames(scene);
    int due = 0;
    for (int output = 0; output <= 180; ++output) {
      const double time = std::min(output * scene.heat->time.output_every, 3600.0);
      EXPECT_EQ(frames.due(time), output % 3 == 0) << output;
      due += frames.due(time) ? 1 : 0;
      EXPECT_NEAR(frames.last(time), 60 * (output / 3), 1e-6) << output;
    }
    EXPECT_EQ(due, 61);
    EXPECT_TRUE(frames.due(3600));
  }
}

TEST(FrameTimes, AreAllOutputsOfASceneWithoutAnIntervalOfFramesAndTheEnd) {
  const auto scenes = std::filesystem::path(SCREE_SOURCE_DIR) / "scenes";
  EXPECT_TRUE(run::FrameTimes(read_scene(scenes / "cooled_plate.yaml", {})).due(0)) << "a steady state";
  const Scene scene =
      read_scene(scenes / "bars_and_joint.yaml", {"heat.until=100 s", "output.every=30 s", "output.frames_every=60 s"});
  const run::FrameTimes frames(scene);
  EXPECT_TRUE(frames.due(100));
  EXPECT_FALSE(frames.due(90));
  EXPECT_EQ(frames.last(90), 60);
  EXPECT_EQ(frames.last(100), 100);
}

}  // namespace
}  // namespace scree::test
