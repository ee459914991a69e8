// What a block's inside resists, against closed forms.
#include "thermal/inner_resistance.h"

#include <cmath>
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
