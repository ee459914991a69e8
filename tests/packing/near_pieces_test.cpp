// Which pieces are near each other, against asking all of them.
#include "engine/packing/near_pieces.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "engine/packing/blocks_in_others.h"
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

// Looking only where boxes lie in each other loses no pair that does.
TEST(BlocksInOthers, HoldTheDeepestPairOfThoseAskedFor) {
  const auto mesh = scattered(Vector3d(2, 1, 1));
  constexpr double depth = 1e-6;
  const PieceSet pieces(mesh);
  for (const Pairs asked : {Pairs::all, Pairs::with_a_free_block, Pairs::of_different_bodies}) {
    const std::vector<BlockId> blocks = blocks_in_others(mesh, depth, asked);
    if (asked == Pairs::all) {
      EXPECT_LT(blocks.size(), mesh.blocks.size());
    }
    const Penetration found = measure_penetration(PieceSet(mesh, blocks), depth, {}, asked);
    const Penetration expected = measure_penetration(pieces, depth, {}, asked);
    EXPECT_GT(expected.max, 0.01);
    EXPECT_EQ(found.max, expected.max);
    EXPECT_EQ(found.first, expected.first);
    EXPECT_EQ(found.second, expected.second);
  }
}

TEST(BlocksInOthers, AreNoneThatOnlyTouchOrThatNobodyAsksAbout) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, Vector3d(4, 4, 1), Vector3d(0, 0, 0), true);
  const BlockId lying = add_box(mesh, Vector3d(1, 1, 1), Vector3d(0, 0, 1), false);
  EXPECT_TRUE(blocks_in_others(mesh, 1e-6, Pairs::all).empty());
  const BlockId other = add_box(mesh, Vector3d(1, 1, 1), Vector3d(0.5, 0, 1.999), false);
  for (const Pairs asked : {Pairs::all, Pairs::with_a_free_block, Pairs::of_different_bodies}) {
    EXPECT_EQ(blocks_in_others(mesh, 1e-6, asked), (std::vector{lying, other}));
    EXPECT_TRUE(blocks_in_others(mesh, 2e-3, asked).empty());
  }
  mesh.blocks[other].body = mesh.blocks[lying].body;
  EXPECT_TRUE(blocks_in_others(mesh, 1e-6, Pairs::of_different_bodies).empty());
  mesh.bodies[mesh.blocks[lying].body].fixed = true;
  EXPECT_TRUE(blocks_in_others(mesh, 1e-6, Pairs::with_a_free_block).empty());
  EXPECT_EQ(blocks_in_others(mesh, 1e-6, Pairs::all), (std::vector{lying, other}));
}

}  // namespace
}  // namespace scree::packing
