// The search against asking the exact geometry about every pair: what bounds in single precision dismiss must not touch.
#include "contact/target_search.h"

#include <gtest/gtest.h>

#include "contact/choice.h"
#include "contact/touch.h"
#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

template <class Target>
Target choose(std::vector<Candidate<Target>>& candidates, double equal) {
  const Candidate<Target>* best = best_of(candidates, equal);
  return best == nullptr ? Target{} : best->target;
}

LargeVector<FaceId> ask_every_face(const Surface<3>& surface, const ContactOptions& options) {
  LargeVector<FaceId> targets;
  for (const FaceId own : surface.faces.ids()) {
    for (int corner = 0; corner < 3; ++corner) {
      std::vector<Candidate<FaceId>> candidates;
      for (const FaceId other : surface.faces.ids()) {
        if (surface.faces[own].block == surface.faces[other].block) continue;
        const auto touch = touch_face(surface, options, PointAndFace{own, corner, other});
        if (touch) candidates.push_back({other, std::abs(touch->gap), -touch->facing});
      }
      targets.push_back(choose(candidates, equal_distance * surface.lengths[own]));
    }
  }
  return targets;
}

bool on_block(const Surface<3>& surface, const LargeVector<FaceId>& springs, const std::array<FaceId, 2>& faces,
              BlockId block) {
  for (const FaceId face : faces) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const FaceId target = springs[face.index() * 3 + corner];
      if (target.valid() && surface.faces[target].block == block) return true;
    }
  }
  return false;
}

std::vector<EdgeId> ask_every_edge(const Surface<3>& surface, const ContactOptions& options,
                                   const LargeVector<FaceId>& springs) {
  std::vector<EdgeId> targets;
  for (const FaceId own : surface.faces.ids()) {
    for (int side = 0; side < 3; ++side) {
      std::vector<Candidate<EdgeId>> candidates;
      for (const EdgeId other : surface.edges.ids()) {
        const BlockId block = surface.faces[surface.edges[other].faces[0]].block;
        if (surface.faces[own].block == block) continue;
        const auto touch = touch_edge(surface, options, own, side, other);
        if (!touch || on_block(surface, springs, surface.edges[surface.face_edges[own][side]].faces, block)) continue;
        if (on_block(surface, springs, surface.edges[other].faces, surface.faces[own].block)) continue;
        candidates.push_back({other, std::abs(touch->gap), std::abs(touch->along - 0.5)});
      }
      targets.push_back(choose(candidates, equal_distance * surface.lengths[own]));
    }
  }
  return targets;
}

std::size_t valid(const auto& targets) {
  return static_cast<std::size_t>(std::count_if(targets.begin(), targets.end(), [](auto id) { return id.valid(); }));
}

// Of all semi-edges, invalid if one has no target.
std::vector<EdgeId> targets_of(const std::vector<TakenEdge>& taken, std::size_t semi_edges) {
  std::vector<EdgeId> targets(semi_edges);
  for (const TakenEdge& edge : taken) targets[edge.semi_edge] = edge.target;
  return targets;
}

void expect_touches(const Surface<3>& surface, const ContactOptions& options, const std::vector<TakenEdge>& taken) {
  for (const TakenEdge& edge : taken) {
    const FaceId owner{edge.semi_edge / 3};
    const auto touch = touch_edge(surface, options, owner, static_cast<int>(edge.semi_edge % 3), edge.target).value();
    EXPECT_EQ(edge.touch.gap, touch.gap);
    EXPECT_EQ(edge.touch.along, touch.along);
    EXPECT_EQ(edge.touch.on_target, touch.on_target);
  }
}

void compare(const mesh::BlockMesh<3>& mesh, const ContactOptions& options, std::size_t least_springs,
             std::size_t least_edges) {
  const Surface<3> surface = make_surface(mesh);
  const Targets<3> found = find_targets(surface, options);
  const auto springs = ask_every_face(surface, options);
  EXPECT_EQ(found.of_springs.faces, springs);
  const auto edges = ask_every_edge(surface, options, springs);
  EXPECT_EQ(targets_of(found.of_edges, edges.size()), edges);
  EXPECT_EQ(found.of_edges.size(), valid(edges));
  expect_touches(surface, options, found.of_edges);
  EXPECT_GE(valid(springs), least_springs);
  EXPECT_GE(valid(edges), least_edges);
}

// Simplices in a crowd, every tenth of them `ratio` times smaller.
BlockOf<3> crowd(std::size_t count, double ratio, unsigned seed) {
  std::mt19937 random(seed);
  BlockOf<3> simplices = random_simplices<3>(count, 1, 0.5, random);
  for (std::size_t i = 0; i < simplices.size(); i += 10) {
    for (auto& corner : simplices[i]) corner = simplices[i][3] + (corner - simplices[i][3]) / ratio;
  }
  return simplices;
}

TEST(FindTargets, MissesNothingAmongBlocksOfOneTetrahedron) {
  for (const unsigned seed : {1, 2, 3}) compare(each_its_own<3>(crowd(60, 1, seed)), {0.05, 0.1}, 100, 30);
}

TEST(FindTargets, MissesNothingBetweenBlocksOfVeryDifferentSize) {
  for (const double ratio : {30.0, 1e3, 1e5}) compare(each_its_own<3>(crowd(60, ratio, 4)), {0.05, 0.1}, 100, 20);
}

TEST(FindTargets, MissesNothingFarFromTheOriginAndOfAnySize) {
  for (const double scale : {1e-6, 1e6}) {
    auto mesh = each_its_own<3>(crowd(50, 1, 5));
    for (auto& node : mesh.nodes) node = scale * (node + at(1000, -2000, 3000));
    compare(mesh, {0.05, 0.1}, 50, 15);
  }
}

TEST(FindTargets, MissesNothingAtASmallToleranceAndIndentation) {
  compare(each_its_own<3>(crowd(90, 1, 6)), {0.01, 0.01}, 20, 1);
  compare(each_its_own<3>(crowd(60, 1, 7)), {0.5, 0.3}, 100, 20);
}

TEST(FindTargets, MissesNothingAmongBlocksOfManyElements) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<BlockOf<3>> blocks;
  for (int i = 0; i < 16; ++i) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
    BlockOf<3> block = box<3>(at(-0.5, -0.5, -0.5), at(1, 0.8, 0.6));
    const Point<3> centre = at(unit(random), unit(random), unit(random));
    // Corners that several simplices have in common must stay the same to the bit.
    for (auto& simplex : block) {
      for (auto& corner : simplex) corner = centre + turn * corner;
    }
    blocks.push_back(block);
  }
  compare(mesh_of<3>(blocks), {0.05, 0.1}, 100, 3);
}

TEST(FindTargets, MissesNothingInALatticeOfClosedJoints) {
  BlockOf<3> simplices;
  for (int i = 0; i < 8; ++i) {
    const auto cell = box<3>(at(i % 2, i / 2 % 2, i / 4), at(1, 1, 1));
    simplices.insert(simplices.end(), cell.begin(), cell.end());
  }
  compare(each_its_own<3>(simplices), {}, 300, 0);
}

// Some faces have the same corners, others lie a little apart, and one block is there twice.
TEST(FindTargets, MissesNothingInALatticeOfWhichAPartHasMoved) {
  BlockOf<3> simplices;
  for (int i = 0; i < 8; ++i) {
    const double moved = i % 3 == 0 ? 3e-3 * i : 0;
    const auto cell = box<3>(at(i % 2 + moved, i / 2 % 2 + 0.7 * moved, i / 4 - 0.4 * moved), at(1, 1, 1));
    simplices.insert(simplices.end(), cell.begin(), cell.end());
  }
  simplices.push_back(simplices[7]);
  compare(each_its_own<3>(simplices), {}, 300, 0);
}

}  // namespace
}  // namespace scree::contact
