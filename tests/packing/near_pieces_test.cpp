// Which pieces are near each other, against asking all of them.
#include "engine/packing/near_pieces.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "engine/packing/mixed_bodies.h"
#include "engine/packing/penetration.h"
#include "tests/rigid/blocks.h"

namespace scree::packing {
namespace {

using Eigen::Vector3d;
using rigid::testing::add_box;

using PartPairs = std::vector<std::pair<const Part*, const Part*>>;

PartPairs sorted(PartPairs pairs) {
  for (auto& [a, b] : pairs) std::tie(a, b) = std::minmax({a, b});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

PartPairs asked_of_all(const std::vector<Part>& parts, double range, Pairs asked) {
  PartPairs pairs;
  for (const Part& a : parts) {
    for (const Part& b : parts) {
      if (&a >= &b || a.block == b.block || a.box.exteriorDistance(b.box) > range) continue;
      if (asked == Pairs::with_a_free_block && a.fixed && b.fixed) continue;
      if (asked == Pairs::of_different_bodies && a.body == b.body) continue;
      pairs.emplace_back(&a, &b);
    }
  }
  return pairs;
}

// Boxes of all sizes, by threes of one body; a long one lies below.
mesh::BlockMesh<3> scattered(const Vector3d& region) {
  std::mt19937 numbers(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto vector = [&] { return Vector3d(uniform(numbers), uniform(numbers), uniform(numbers)); };
  mesh::BlockMesh<3> mesh;
  add_box(mesh, Vector3d(2 * region.x(), 2 * region.y(), 0.1), Vector3d(0, 0, 0), true);
  for (int i = 0; i < 150; ++i) {
    const double size = 0.01 * std::pow(40, uniform(numbers));
    const Eigen::Quaterniond turn(uniform(numbers), uniform(numbers), uniform(numbers), uniform(numbers));
    const Pose pose{region.cwiseProduct(vector()), turn.normalized()};
    const BlockId block = add_box(mesh, size * (vector() + Vector3d(0.1, 0.1, 0.1)), pose, i / 3 % 2 == 0);
    mesh.blocks[block].body = mesh.blocks[BlockId{block.index() - i % 3}].body;
  }
  return mesh;
}

TEST(NearPairs, AreThoseOfAskingAllWhateverTheRegionIsLike) {
  for (const Vector3d& region : {Vector3d(1, 1, 1), Vector3d(5, 1, 0.2), Vector3d(0.3, 1, 9), Vector3d(0.2, 0.2, 0.2)}) {
    const auto mesh = scattered(region);
    const PieceSet pieces(mesh);
    for (const double range : {0.0, 1e-3, 0.3}) {
      for (const Pairs asked : {Pairs::all, Pairs::with_a_free_block, Pairs::of_different_bodies}) {
        const PartPairs expected = asked_of_all(pieces.parts, range, asked);
        EXPECT_GT(expected.size(), 20U);
        EXPECT_EQ(sorted(near_pairs(pieces.parts, range, asked)), sorted(expected)) << region.transpose() << ", " << range;
      }
    }
  }
}

TEST(NearPairs, OfNoPartsAreNone) {
  EXPECT_TRUE(near_pairs({}, 1).empty());
}

// Looking only where bodies' boxes meet loses no pair that is in each other.
TEST(Penetration, OfDifferentBodiesIsThatOfTheDeepestPairOfSuch) {
  const auto mesh = scattered(Vector3d(2, 1, 1));
  constexpr double depth = 1e-6;
  const Penetration found = measure_penetration(mesh, depth, {}, Pairs::of_different_bodies);
  const PieceSet pieces(mesh);
  double deepest = 0;
  std::size_t deep = 0;
  for (const auto& [a, b] : asked_of_all(pieces.parts, 0, Pairs::of_different_bodies)) {
    const double distance = separation(a->placed, b->placed, 0).distance;
    deepest = std::max(deepest, -distance);
    deep += distance < -depth ? 1 : 0;
  }
  EXPECT_GT(deep, 5U);
  EXPECT_DOUBLE_EQ(found.max, deepest);
}

TEST(MixedBodies, HoldNoBlockThatOnlyTouchesAnotherBody) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, Vector3d(4, 4, 1), Vector3d(0, 0, 0), true);
  add_box(mesh, Vector3d(1, 1, 1), Vector3d(0, 0, 1), false);
  EXPECT_TRUE(blocks_in_other_bodies(mesh, 1e-6).empty());
  add_box(mesh, Vector3d(1, 1, 1), Vector3d(0.5, 0, 1.999), false);
  EXPECT_EQ(blocks_in_other_bodies(mesh, 1e-6), (std::vector{BlockId{1}, BlockId{2}}));
  EXPECT_TRUE(blocks_in_other_bodies(mesh, 2e-3).empty());
}

}  // namespace
}  // namespace scree::packing
