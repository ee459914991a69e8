// Parts of elements and faces in boxes, against their sum over a grid of boxes and against closed forms.
#include "engine/mesh/part_in_box.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scree::mesh {
namespace {

TEST(PartInBox, ACornerOfTheUnitTetrahedronIsASmallerOne) {
  Corners<3, 4> tetrahedron = Corners<3, 4>::Zero();
  tetrahedron.rightCols<3>().setIdentity();
  const auto share = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return 6 * shares_in_box<3, 4>(tetrahedron, {low, high}, 0).sum();
  };
  EXPECT_NEAR(share({0, 0, 0.5}, {1, 1, 1}), 0.125, 1e-15);
  EXPECT_NEAR(share({0, 0, 0}, {1, 1, 0.5}), 0.875, 1e-15);
  EXPECT_NEAR(share({0, 0, 0}, {0.25, 0.25, 0.25}), 6 * 0.25 * 0.25 * 0.25, 1e-15) << "the box is inside";
  EXPECT_EQ(share({0.6, 0.6, 0}, {1, 1, 1}), 0) << "its box is met, and it is not";
  EXPECT_EQ(share({0, 0, -1}, {1, 1, 0}), 0) << "a face lies on the side";
}

TEST(PartInBox, SharesAreIntegralsOfLinearFunctions) {
  const Corners<2, 2> edge{{0, 1}, {0, 0}};
  const auto half = shares_in_box<2, 2>(edge, {Point<2>(-1, -1), Point<2>(0.5, 1)}, 0);
  EXPECT_NEAR(half[0], 0.375, 1e-15);
  EXPECT_NEAR(half[1], 0.125, 1e-15);
  // The triangle 0 <= y <= x <= 1 in the plane z = 2 below y = 1/2: integrals by hand.
  const Corners<3, 3> face{{0, 1, 1}, {0, 0, 1}, {2, 2, 2}};
  const auto part = shares_in_box<3, 3>(face, {Point<3>(-1, -1, 1), Point<3>(2, 0.5, 3)}, 0);
  EXPECT_NEAR(part.sum(), 0.375, 1e-15);
  EXPECT_NEAR(part[2], 1.0 / 12, 1e-15) << "the integral of y";
  EXPECT_NEAR(part[1] + part[2], 11.0 / 48, 1e-15) << "the integral of x";
}

TEST(PartInBox, ASideCutsTheUnitTetrahedronInASmallerTriangle) {
  Corners<3, 4> tetrahedron = Corners<3, 4>::Zero();
  tetrahedron.rightCols<3>().setIdentity();
  const Aabb<3> box(Point<3>(-1, -1, 0.25), Point<3>(1, 1, 0.5));
  const auto low = shares_on_side<3>(tetrahedron, box, 2, false, 0);
  EXPECT_NEAR(low.sum(), 0.75 * 0.75 / 2, 1e-15);
  EXPECT_NEAR(low[3], 0.25 * 0.75 * 0.75 / 2, 1e-15) << "the integral of z";
  EXPECT_NEAR(shares_on_side<3>(tetrahedron, box, 2, true, 0).sum(), 0.125, 1e-15);
  EXPECT_EQ(shares_on_side<3>(tetrahedron, box, 0, true, 0).sum(), 0) << "a corner lies on the side";
}

// Two corners on either side: a rectangle of edges in the ways of the other two pairs.
TEST(PartInBox, ASideCutsATetrahedronInAQuadrilateral) {
  const Corners<3, 4> tetrahedron{{-1, 1, 0, 0}, {0, 0, -1, 1}, {0, 0, 1, 1}};
  for (const bool high : {false, true}) {
    const Aabb<3> box =
        high ? Aabb<3>(Point<3>(-2, -2, -1), Point<3>(2, 2, 0.25)) : Aabb<3>(Point<3>(-2, -2, 0.25), Point<3>(2, 2, 2));
    const auto shares = shares_on_side<3>(tetrahedron, box, 2, high, 0);
    EXPECT_NEAR(shares.sum(), 1.5 * 0.5, 1e-15) << high;
    EXPECT_NEAR(shares[2] + shares[3], 0.25 * 0.75, 1e-15) << "the integral of z";
    EXPECT_NEAR(shares[0], shares[1], 1e-15);
  }
}

TEST(PartInBox, AFaceInASideCountsForTheElementWithin) {
  const Corners<2, 3> above{{0, 1, 0}, {0, 0, 1}}, below{{0, 1, 0}, {0, 0, -1}};
  const Aabb<2> box(Point<2>(0.5, 1e-10), Point<2>(2, 2));
  EXPECT_NEAR(shares_on_side<2>(above, box, 1, false, 1e-9).sum(), 0.5, 1e-15);
  EXPECT_EQ(shares_on_side<2>(below, box, 1, false, 1e-9).sum(), 0);
}

TEST(PartInBox, AFaceInASideOfTheBoxCountsUpToRounding) {
  const Corners<3, 3> face{{0, 1, 1}, {0, 0, 1}, {1e-10, 0, -1e-10}};
  const auto share = [&](double low, double high) {
    return shares_in_box<3, 3>(face, {Point<3>(0, 0, low), Point<3>(0.5, 1, high)}, 1e-9).sum();
  };
  EXPECT_NEAR(share(0, 1), 0.125, 1e-15);
  EXPECT_NEAR(share(-1, 0), 0.125, 1e-15);
  EXPECT_EQ(share(1e-8, 1), 0);
}

// Simplices of two sizes: elements and faces.
template <class Kind>
class PartsInBoxes : public testing::Test {};
template <int of_dim, int of_corners>
struct Simplex {
  static constexpr int dim = of_dim, corners = of_corners;
};
using Kinds = testing::Types<Simplex<2, 2>, Simplex<2, 3>, Simplex<3, 3>, Simplex<3, 4>>;
TYPED_TEST_SUITE(PartsInBoxes, Kinds);

TYPED_TEST(PartsInBoxes, OfAGridAddUpToTheWholeCornerByCorner) {
  constexpr int dim = TypeParam::dim, corners = TypeParam::corners;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Corners<dim, corners> simplex;
    for (double& value : simplex.reshaped()) value = place(random);
    constexpr int cells = 4;
    Eigen::Array<double, corners, 1> sum = Eigen::Array<double, corners, 1>::Zero();
    for (int i = 0; i < cells * cells * (dim == 3 ? cells : 1); ++i) {
      Point<dim> low;
      for (int axis = 0, rest = i; axis < dim; ++axis, rest /= cells) low[axis] = (rest % cells) / static_cast<double>(cells);
      sum += shares_in_box<dim, corners>(simplex, {low, low + Point<dim>::Constant(1.0 / cells)}, 0);
    }
    const Eigen::MatrixXd edges = simplex.rightCols(corners - 1).colwise() - simplex.col(0);
    const double gram = std::sqrt((edges.transpose() * edges).determinant());
    const double share = gram / std::tgamma(corners + 1);
    EXPECT_LT((sum - share).abs().maxCoeff(), 1e-14) << sum.transpose() << " instead of " << share;
  }
}

}  // namespace
}  // namespace scree::mesh
