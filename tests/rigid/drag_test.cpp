// Drag stays on as long as anything falls, against the closed form of a fall under it.
#include <cmath>

#include <gtest/gtest.h>

#include "engine/rigid/settle.h"
#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using testing::add_box;
using testing::g;
using testing::plate;

SettleOptions with_drag(double drag, double limit) {
  SettleOptions options;
  options.viscous_damping = drag;
  options.limit = limit;
  options.step = 0.5e-3;
  return options;
}

// How far up from where it was thrown, at that speed.
double height_after(double time, double drag, double speed) {
  return (speed + g / drag) / drag * (1 - std::exp(-drag * time)) - g / drag * time;
}

// It turns at 0.62 s, where nothing moves.
TEST(Drag, OfABlockThrownUpIsThereOnItsWayDown) {
  for (const double time : {0.6, 1.3}) {
    mesh::BlockMesh<3> mesh = plate(8);
    const BlockId block = add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.1}, false, {0, 0, 12});
    add_box(mesh, {0.1, 0.1, 0.1}, {1, 0, 0.05}, false);  // it is not one fall of all
    const double height = settle(mesh, testing::material(0.5), with_drag(2, time)).poses[block].translation.z();
    EXPECT_NEAR(height, height_after(time, 2, 12), 0.01) << time;
  }
}

// In the mean over masses nothing moves.
TEST(Drag, OfAPebbleThatFallsBesideABoulderIsThereUntilItLands) {
  mesh::BlockMesh<3> mesh = plate(8);
  add_box(mesh, {1, 1, 1}, {0, 0, 0.5}, false);
  const BlockId pebble = add_box(mesh, {0.02, 0.02, 0.02}, {2, 0, 3}, false);
  const packing::Packing<3> packing = settle(mesh, testing::material(0.5), with_drag(10, 2));
  EXPECT_NEAR(packing.poses[pebble].translation.z(), height_after(2, 10, 0), 0.01);
  EXPECT_NE(packing.settled->criterion.find("the drag was still on, for block 2 fell"), std::string::npos)
      << packing.settled->criterion;
}

// Bounces to 1.40 and 0.62 m: drag takes half of what a restitution of 0.9 leaves.
TEST(Drag, OfABlockThatBouncesIsThereAtTheTopOfItsWay) {
  mesh::BlockMesh<3> mesh = plate(8);
  const BlockId block = add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 5.05}, false);
  add_box(mesh, {0.1, 0.1, 0.1}, {1, 0, 0.05}, false);
  Table<MaterialId, Material> bouncing = testing::material(0.5);
  bouncing[MaterialId{0}].restitution = 0.9;
  const auto speed_after = [](double height) {
    double low = 0, high = 10;
    for (int i = 0; i < 60; ++i) (height_after(0.5 * (low + high), 1, 0) > -height ? low : high) = 0.5 * (low + high);
    return g * (1 - std::exp(-low));
  };
  const auto peak_of = [](double speed) { return speed - g * std::log(1 + speed / g); };
  const double first = peak_of(0.9 * speed_after(5)), second = peak_of(0.9 * speed_after(first));
  double highest = 0;
  settle(mesh, bouncing, with_drag(1, 3), [&](double time, const Table<BlockId, Pose>& poses) {
    if (time > 2.4) highest = std::max(highest, 5 + poses[block].translation.z());
  });
  EXPECT_NEAR(highest, second, 0.02);
}

// Let go last, when the others lie still.
TEST(Drag, OfABlockThatIsLetGoLastIsThereUntilItLands) {
  mesh::BlockMesh<3> mesh = plate(8);
  for (int i = 0; i < 20; ++i) add_box(mesh, {0.1, 0.1, 0.1}, {0.2 * i - 2, 0, 0.05}, false);
  const BlockId last = add_box(mesh, {0.1, 0.1, 0.1}, {0, 2, 3}, false);
  SettleOptions options = with_drag(10, 3);
  options.release_time = 1;
  const double height = settle(mesh, testing::material(0.5), options).poses[last].translation.z();
  EXPECT_GT(height, height_after(2.1, 10, 0)) << "it hangs for the first second, but for a twentieth";
  EXPECT_LT(height, height_after(1.9, 10, 0));
}

}  // namespace
}  // namespace scree::rigid
