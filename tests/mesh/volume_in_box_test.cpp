// Parts of simplices in boxes, against their sum over a grid of boxes and against closed forms.
#include "engine/mesh/volume_in_box.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scree::mesh {
namespace {

template <int dim>
BlockMesh<dim> one_simplex(const Eigen::Matrix<double, dim, dim + 1>& corners) {
  BlockMesh<dim> mesh;
  typename BlockMesh<dim>::Element simplex;
  for (int corner = 0; corner <= dim; ++corner) {
    simplex[corner] = NodeId(static_cast<std::size_t>(corner));
    mesh.nodes.push_back(corners.col(corner));
  }
  mesh.elements.push_back(simplex);
  return mesh;
}

TEST(VolumeInBox, ACornerOfTheUnitTetrahedronIsASmallerOne) {
  Eigen::Matrix<double, 3, 4> corners = Eigen::Matrix<double, 3, 4>::Zero();
  corners.rightCols<3>().setIdentity();
  const auto mesh = one_simplex<3>(corners);
  const auto share = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return 6 * volume_in_box(mesh, ElementId{0}, {low, high});
  };
  EXPECT_NEAR(share({0, 0, 0.5}, {1, 1, 1}), 0.125, 1e-15);
  EXPECT_NEAR(share({0, 0, 0}, {1, 1, 0.5}), 0.875, 1e-15);
  EXPECT_NEAR(share({0, 0, 0}, {0.25, 0.25, 0.25}), 6 * 0.25 * 0.25 * 0.25, 1e-15) << "the box is inside";
  EXPECT_EQ(share({0.6, 0.6, 0}, {1, 1, 1}), 0) << "its box is met, and it is not";
  EXPECT_EQ(share({0, 0, -1}, {1, 1, 0}), 0) << "a face lies on the side";
}

template <class Dim>
class PartsInBoxes : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PartsInBoxes, Dimensions);

TYPED_TEST(PartsInBoxes, OfAGridAddUpToTheElement) {
  constexpr int dim = TypeParam::value;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Matrix<double, dim, dim + 1> corners;
    for (double& value : corners.reshaped()) value = place(random);
    const auto mesh = one_simplex<dim>(corners);
    constexpr int cells = 4;
    double sum = 0;
    for (int i = 0; i < cells * cells * (dim == 3 ? cells : 1); ++i) {
      Point<dim> low;
      for (int axis = 0, rest = i; axis < dim; ++axis, rest /= cells) low[axis] = (rest % cells) / static_cast<double>(cells);
      sum += volume_in_box(mesh, ElementId{0}, {low, low + Point<dim>::Constant(1.0 / cells)});
    }
    EXPECT_NEAR(sum, std::abs(element_volume(mesh, ElementId{0})), 1e-15) << "whichever way its corners turn";
  }
}

}  // namespace
}  // namespace scree::mesh
