// What must not depend on how long a step is.
#include <gtest/gtest.h>

#include "tests/rigid/blocks.h"

namespace scree::rigid {
namespace {

using testing::add_box;
using testing::for_time;
using testing::material;

// However fine the step: within one the block moves less than what lets a pair keep its points.
TEST(Settle, RestitutionDoesNotDependOnTheStep) {
  for (const double step : {1.0 / 240, 1e-3, 1e-4}) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {1, 1, 0.1}, {0, 0, -0.05}, true);
    const BlockId block = add_box(mesh, {0.1, 0.1, 0.1}, {0, 0, 0.1}, false);
    SettleOptions options = for_time(0.22);
    options.step = step;
    const double rise = settle(mesh, material(0.5, 1), options).poses[block].translation.z();
    EXPECT_NEAR(rise, 0, 0.05 * 0.3) << step << ": it is back up after twice sqrt(2 * 0.05 / g) = 0.2 s";
  }
}

// The step's own fall is as deep as the blocks are large.
TEST(Settle, NothingFallsThroughAShelfInTheStepItIsLetGoIn) {
  for (const double size : {5e-5, 1e-3}) {
    mesh::BlockMesh<3> mesh;
    add_box(mesh, {20 * size, 20 * size, size}, {0, 0, -0.5 * size}, true);
    const BlockId block = add_box(mesh, {size, size, size}, {0, 0, 0.52 * size}, false);
    const auto packing = settle(mesh, material(0.5), for_time(0.1));
    EXPECT_NEAR(packing.poses[block].translation.z(), -0.02 * size, 1e-6 * size) << size;
    EXPECT_LT(packing.settled->deepest_overlap, 1e-6) << size;
  }
}

}  // namespace
}  // namespace scree::rigid
