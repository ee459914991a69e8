// What a block's inside resists, against closed forms.
#include "thermal/inner_resistance.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"

namespace scree::thermal {
namespace {

TEST(InnerResistance, OfACubeHeatedAllOverIsExact) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(0.3, 2, 3, 0.3)});
  const InnerResistance<3> inside(mesh, BlockId{0}, 5 * Tensor<3>::Identity());
  EXPECT_NEAR(inside.volume(), 0.027, 1e-15);
  PatchMoments<3> all_over;
  all_over.weight = 2;
  all_over.second = 2 * 5.0 / 36 * 0.09 * Tensor<3>::Identity();  // mean of x^2 over the surface
  EXPECT_NEAR(inside.bulk(all_over), 1 / (12 * 5 * 0.3), 1e-12);
}

TEST(InnerResistance, OfAnAnisotropicBarIsThatAlongIt) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(0.5, 5, 2, 0.1)});
  const InnerResistance<3> inside(mesh, BlockId{0}, Eigen::Vector3d(2, 7, 9).asDiagonal());
  PatchMoments<3> end;
  // A face's corners have thrice the second moment of the face: points at 1/sqrt 3 of them have the face's own.
  for (const double y : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) end.add(Point<3>(0.25, 0.05 * y / std::sqrt(3), 0.05 * z / std::sqrt(3)), 0.3);
  }
  EXPECT_NEAR(inside.bulk(end), 0.5 / (3 * 2 * 0.01), 1e-10);
}

// A block of squares with the edge 0.02 m, each of two triangles.
class Squares {
 public:
  Squares() { mesh.bodies.push_back({"squares", MaterialId{0}, false, {}}); }

  NodeId node(int i, int j) {
    const auto [found, is_new] = nodes_.try_emplace({i, j}, NodeId{mesh.nodes.size()});
    if (is_new) mesh.nodes.push_back(Point<2>(0.02 * i, 0.02 * j));
    return found->second;
  }

  void add(int i, int j) {
    mesh.elements.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
    mesh.elements.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
  }

  const mesh::BlockMesh<2>& as_block() {
    mesh.blocks.push_back({BodyId{0}, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
    return mesh;
  }

  mesh::BlockMesh<2> mesh;

 private:
  std::map<std::pair<int, int>, NodeId> nodes_;
};

// Two legs beside each other, joined at one end. The heat of a leg's end has to pass both: that of a bar, L/(3 k A).
TEST(InnerResistance, OfAHairpinIsThatOfABarAsLongAsBothLegs) {
  Squares squares;
  constexpr int rows = 40;
  for (int j = 0; j < rows; ++j) {
    squares.add(0, j);
    squares.add(2, j);
  }
  squares.add(1, 0);
  const std::array<NodeId, 2> end{squares.node(0, rows), squares.node(1, rows)};
  const InnerResistance<2> inside(squares.as_block(), BlockId{0}, 5 * Tensor<2>::Identity());
  PatchMoments<2> patch;
  for (const NodeId node : end) inside.add(node, 0.5, patch);
  const double length = 2 * 0.02 * rows;
  EXPECT_NEAR(inside.bulk(patch) * 3 * 5 * 0.02 / length, 1, 0.02);
}

// Two squares of 20 x 20 with a neck of 4 x 1 between them, heated at the far side of one. Half of the heat passes the neck, of
// length over width 4, and its openings, each ln(1/sin(pi w/(2 W)))/(pi k) of a channel of width W that narrows to w; on the
// way from the mean of the one square to that of the other it passes 1/(3 k) and 1/(6 k) of the squares, whose flow falls
// evenly from 1 to 1/2 and from there to 0. Each mean is half of that off the mean of all, and the heated side another 5/(12
// k).
TEST(InnerResistance, OfANarrowNeckIsThatOfTheNeck) {
  Squares squares;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      squares.add(i, j);
      squares.add(i + 24, j);
    }
  }
  for (int i = 20; i < 24; ++i) squares.add(i, 10);
  std::vector<NodeId> side;
  for (int j = 0; j <= 20; ++j) side.push_back(squares.node(0, j));
  const InnerResistance<2> inside(squares.as_block(), BlockId{0}, 5 * Tensor<2>::Identity());
  PatchMoments<2> patch;
  for (const NodeId node : side) inside.add(node, 1, patch);
  constexpr double k = 5;
  const double opening = std::log(1 / std::sin(std::numbers::pi / 40)) / (std::numbers::pi * k);
  const double between_means = 0.5 * (4 / k + 2 * opening) + 1 / (3 * k) + 1 / (6 * k);
  EXPECT_NEAR(inside.bulk(patch) / (0.5 * between_means + 5 / (12 * k)), 1, 0.03);
}

// With and without a slit that parts it nearly.
TEST(InnerResistance, SeesDentsWithoutVolume) {
  for (const bool slit : {false, true}) {
    Squares squares;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        if (!(slit && i == 2 && j > 0)) squares.add(i, j);
      }
    }
    EXPECT_EQ(is_dented(squares.as_block(), BlockId{0}), slit);
  }
}

TEST(InnerResistance, OfASmallPatchIsThatOfADiscOnAHalfSpace) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 1, 1, 1)});
  const InnerResistance<3> inside(mesh, BlockId{0}, 3 * Tensor<3>::Identity());
  const double radius = 1e-6;
  EXPECT_NEAR(inside.constriction(std::numbers::pi * radius * radius) * 4 * 3 * radius, 1, 1e-5);
  EXPECT_EQ(inside.constriction(100), 0);
}

// What a ball in the middle of another one is warmer by than the rim, the whole block taken for that.
TEST(InnerResistance, OfAPartOfTheVolumeIsThatOfABallWithinABall) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 1, 1, 1)});
  const InnerResistance<3> inside(mesh, BlockId{0}, 3 * Tensor<3>::Identity());
  const double inner = 1e-6, outer = std::cbrt(0.75 / std::numbers::pi);
  const double stated = inside.constriction_within(std::numbers::pi / 0.75 * inner * inner * inner);
  EXPECT_NEAR(stated * 8 * std::numbers::pi * 3, 3 * (1 / inner - 1 / outer), 1e-3);
  EXPECT_EQ(inside.constriction_within(1), 0);
}

}  // namespace
}  // namespace scree::thermal
