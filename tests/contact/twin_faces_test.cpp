#include "contact/twin_faces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "contact/semi_spring.h"
#include "contact/target_search.h"
#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

// Two by two by two cubes of six tetrahedra each, or as many squares of two triangles.
template <int dim>
BlockOf<dim> lattice() {
  BlockOf<dim> simplices;
  for (int i = 0; i < 1 << dim; ++i) {
    Point<dim> low;
    for (int axis = 0; axis < dim; ++axis) low[axis] = i >> axis & 1;
    const auto cell = box<dim>(low, Point<dim>::Ones());
    simplices.insert(simplices.end(), cell.begin(), cell.end());
  }
  return simplices;
}

template <int dim>
SpringTargets<dim> twins_of(const Surface<dim>& surface) {
  SpringTargets<dim> targets(surface);
  take_twins(surface, {}, targets);
  return targets;
}

std::size_t taken(const LargeVector<FaceId>& targets) {
  return static_cast<std::size_t>(std::count_if(targets.begin(), targets.end(), [](FaceId id) { return id.valid(); }));
}

template <int dim>
void expect_no_distance(const Surface<dim>& surface, const SpringTargets<dim>& targets) {
  for (std::size_t spring = 0; spring < targets.faces.size(); ++spring) {
    if (!targets.faces[spring].valid()) continue;
    const auto weights = semi_spring_weights<dim>(static_cast<int>(spring % dim), ContactOptions{}.indentation);
    const Point<dim> own = weighted_point<dim>(corners_of(surface, FaceId{spring / dim}), weights);
    const auto& touch = targets.touches[spring];
    const Point<dim> its = weighted_point<dim>(corners_of(surface, targets.faces[spring]), touch.on_target);
    EXPECT_LE((own - its).norm(), 1e-15);
    EXPECT_EQ(touch.gap, 0);
    EXPECT_EQ(targets.blocks[spring], surface.faces[targets.faces[spring]].block);
  }
}

template <int dim>
void expect_all_but_the_outside(std::size_t outside) {
  const auto mesh = each_its_own<dim>(lattice<dim>());
  const Surface<dim> surface = make_surface(mesh);
  const SpringTargets<dim> targets = twins_of(surface);
  EXPECT_EQ(taken(targets.faces), (surface.faces.size() - outside) * dim);
  expect_no_distance(surface, targets);
}

TEST(TwinFaces, OfALatticeOfClosedJointsAreAllButTheOutside) {
  expect_all_but_the_outside<2>(8);
  expect_all_but_the_outside<3>(48);
}

// The same targets as a search finds, which all joints need once no corner is the same to the bit.
TEST(TwinFaces, TakeWhatTheSearchFinds) {
  auto mesh = each_its_own<3>(lattice<3>());
  const Surface<3> surface = make_surface(mesh);
  const Targets<3> as_twins = find_targets(surface, ContactOptions{});
  auto moved = mesh;
  for (const BlockId block : moved.blocks.ids()) {
    for (const NodeId node : moved.blocks[block].nodes) {
      for (double& axis : moved.nodes[node]) axis += 1e-14 * static_cast<double>(block.index() + 1);
    }
  }
  const Surface<3> searched = make_surface(moved);
  EXPECT_EQ(taken(twins_of(searched).faces), 0u);
  const Targets<3> found = find_targets(searched, ContactOptions{});
  EXPECT_EQ(found.of_springs.faces, as_twins.of_springs.faces);
  EXPECT_TRUE(found.of_edges.empty() && as_twins.of_edges.empty());
  for (std::size_t spring = 0; spring < found.of_springs.faces.size(); ++spring) {
    if (!found.of_springs.faces[spring].valid()) continue;
    EXPECT_NEAR(found.of_springs.touches[spring].gap, as_twins.of_springs.touches[spring].gap, 1e-12);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.of_springs.touches[spring].on_target[i], as_twins.of_springs.touches[spring].on_target[i], 1e-12);
    }
  }
}

TEST(TwinFaces, AreNoneWhereOneCornerIsOffByABit) {
  auto mesh = each_its_own<3>(
      {{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}, {at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, -1)}});
  EXPECT_EQ(taken(twins_of(make_surface(mesh)).faces), 6u);
  for (auto& node : mesh.nodes) {
    if (node == at(1, 0, 0)) {
      node.x() = std::nextafter(1.0, 2.0);
      break;
    }
  }
  EXPECT_EQ(taken(twins_of(make_surface(mesh)).faces), 0u);
}

TEST(TwinFaces, AreNoneWhereTheyLookTheSameWayOrAThirdOneHasTheSameCorners) {
  const Simplex<3> above{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)};
  const Simplex<3> below{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, -1)};
  const Simplex<3> far_below{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, -2)};
  EXPECT_EQ(taken(twins_of(make_surface(each_its_own<3>({below, far_below}))).faces), 0u);
  EXPECT_EQ(taken(twins_of(make_surface(each_its_own<3>({above, below, far_below}))).faces), 0u);
}

TEST(TwinFaces, MayHaveACornerAtMinusZero) {
  EXPECT_EQ(taken(twins_of(make_surface(each_its_own<3>({{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)},
                                                         {at(-0.0, 0, 0), at(1, -0.0, 0), at(0, 1, 0), at(0, 0, -1)}})))
                      .faces),
            6u);
}

}  // namespace
}  // namespace scree::contact
