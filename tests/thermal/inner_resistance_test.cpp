// What a block's inside resists, against closed forms.
#include "thermal/inner_resistance.h"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"

namespace scree::thermal {
namespace {

TEST(InnerResistance, OfACubeHeatedAllOverIsExact) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(0.3, 2, 3, 0.3)});
  const InnerResistance<3> inside(mesh, mesh.blocks[BlockId{0}], 5 * Tensor<3>::Identity());
  EXPECT_NEAR(inside.volume(), 0.027, 1e-15);
  PatchMoments<3> all_over;
  all_over.weight = 2;
  all_over.second = 2 * 5.0 / 36 * 0.09 * Tensor<3>::Identity();  // mean of x^2 over the surface
  EXPECT_NEAR(inside.bulk(all_over), 1 / (12 * 5 * 0.3), 1e-12);
}

TEST(InnerResistance, OfAnAnisotropicBarIsThatAlongIt) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(0.5, 5, 2, 0.1)});
  const InnerResistance<3> inside(mesh, mesh.blocks[BlockId{0}], Eigen::Vector3d(2, 7, 9).asDiagonal());
  PatchMoments<3> end;
  // A face's corners have thrice the second moment of the face: points at 1/sqrt 3 of them have the face's own.
  for (const double y : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) end.add(Point<3>(0.25, 0.05 * y / std::sqrt(3), 0.05 * z / std::sqrt(3)), 0.3);
  }
  EXPECT_NEAR(inside.bulk(end), 0.5 / (3 * 2 * 0.01), 1e-10);
}

// Squares of 0.02 m: two legs beside each other, joined at one end. The heat of a leg's end has to pass both.
TEST(InnerResistance, OfAHairpinIsThatOfABarAsLongAsBothLegs) {
  mesh::BlockMesh<2> mesh;
  mesh.bodies.push_back({"hairpin", MaterialId{0}, false, {}});
  std::map<std::pair<int, int>, NodeId> nodes;
  const auto node = [&](int i, int j) {
    const auto [found, is_new] = nodes.try_emplace({i, j}, NodeId{mesh.nodes.size()});
    if (is_new) mesh.nodes.push_back(Point<2>(0.02 * i, 0.02 * j));
    return found->second;
  };
  constexpr int rows = 40;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < (i == 1 ? 1 : rows); ++j) {
      mesh.elements.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh.elements.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  mesh.blocks.push_back({BodyId{0}, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
  const InnerResistance<2> inside(mesh, mesh.blocks[BlockId{0}], 5 * Tensor<2>::Identity());
  PatchMoments<2> end;
  end.add(Point<2>(0.01, 0.02 * rows) - inside.centroid(), 1);
  const double length = 2 * 0.02 * rows;
  EXPECT_GT(inside.bulk(end), length / (3 * 5 * 0.02));
  EXPECT_LT(inside.bulk(end), 2 * length / (3 * 5 * 0.02));
}

TEST(InnerResistance, OfASmallPatchIsThatOfADiscOnAHalfSpace) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 1, 1, 1)});
  const InnerResistance<3> inside(mesh, mesh.blocks[BlockId{0}], 3 * Tensor<3>::Identity());
  const double radius = 1e-6;
  EXPECT_NEAR(inside.constriction(std::numbers::pi * radius * radius) * 4 * 3 * radius, 1, 1e-5);
  EXPECT_EQ(inside.constriction(100), 0);
}

// What a ball in the middle of another one is warmer by than the rim, the whole block taken for that.
TEST(InnerResistance, OfAPartOfTheVolumeIsThatOfABallWithinABall) {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(1, 1, 1, 1)});
  const InnerResistance<3> inside(mesh, mesh.blocks[BlockId{0}], 3 * Tensor<3>::Identity());
  const double inner = 1e-6, outer = std::cbrt(0.75 / std::numbers::pi);
  const double stated = inside.constriction_within(std::numbers::pi / 0.75 * inner * inner * inner);
  EXPECT_NEAR(stated * 8 * std::numbers::pi * 3, 3 * (1 / inner - 1 / outer), 1e-3);
  EXPECT_EQ(inside.constriction_within(1), 0);
}

}  // namespace
}  // namespace scree::thermal
