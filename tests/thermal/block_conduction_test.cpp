#include "thermal/block_conduction.h"

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"

namespace scree::thermal {
namespace {

template <class Dim>
class BlockConduction : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BlockConduction, Dimensions);

// A crooked, positively oriented simplex.
template <int dim>
Corners<dim> crooked() {
  Corners<dim> points;
  if constexpr (dim == 2) {
    points << 0.1, 1.3, 0.4, -0.2, 0.1, 0.9;
  } else {
    points << 0.1, 1.3, 0.4, 0.3, -0.2, 0.1, 0.9, 0.2, 0.05, -0.1, 0.2, 1.1;
  }
  return points;
}

template <int dim>
double volume(const Corners<dim>& points) {
  Eigen::Matrix<double, dim, dim> edges;
  for (int i = 0; i < dim; ++i) edges.col(i) = points.col(i + 1) - points.col(0);
  return edges.determinant() / (dim == 2 ? 2 : 6);
}

// Eqs. (4) and (5) as printed: face by face, from the faces' mean temperatures.
template <int dim>
CornerValues<dim> literal_node_flows(const Corners<dim>& points, double conductivity, const CornerValues<dim>& temperature) {
  const Corners<dim> area = opposite_areas<dim>(points);
  Point<dim> flux = Point<dim>::Zero();
  for (int f = 0; f <= dim; ++f) {
    const double face_mean = (temperature.sum() - temperature[f]) / dim;
    flux -= conductivity / volume<dim>(points) * face_mean * area.col(f);
  }
  CornerValues<dim> flow = CornerValues<dim>::Zero();
  for (int node = 0; node <= dim; ++node) {
    for (int f = 0; f <= dim; ++f) {
      if (f != node) flow[node] += flux.dot(area.col(f)) / dim;
    }
  }
  return flow;
}

TYPED_TEST(BlockConduction, AreaVectorsPointOutwardsAndSumToZero) {
  constexpr int dim = TypeParam::value;
  const Corners<dim> points = crooked<dim>();
  const Corners<dim> area = opposite_areas<dim>(points);
  EXPECT_LT(area.rowwise().sum().norm(), 1e-15);
  for (int a = 0; a <= dim; ++a) {
    const Point<dim> on_face = points.col((a + 1) % (dim + 1));
    EXPECT_NEAR(area.col(a).dot(on_face - points.col(a)), dim * volume<dim>(points), 1e-14);
  }
}

TYPED_TEST(BlockConduction, StiffnessIsEquationsFourAndFiveAsPrinted) {
  constexpr int dim = TypeParam::value;
  const Corners<dim> points = crooked<dim>();
  const CornerMatrix<dim> stiffness = element_conductance<dim>(points, 3.1 * Tensor<dim>::Identity());
  for (int b = 0; b <= dim; ++b) {
    const CornerValues<dim> flow = literal_node_flows<dim>(points, 3.1, CornerValues<dim>::Unit(b));
    EXPECT_LT((flow + stiffness.col(b)).norm(), 1e-14 * stiffness.norm());
  }
}

TYPED_TEST(BlockConduction, FluxOfALinearFieldIsMinusConductivityTimesItsGradient) {
  constexpr int dim = TypeParam::value;
  const Corners<dim> points = crooked<dim>();
  const Point<dim> gradient = Point<dim>::LinSpaced(2.0, -1.0);
  const CornerValues<dim> temperature = (points.transpose() * gradient).array() + 350.0;
  const auto found = thermal::gradient<dim>([&](int a, int i) { return points(i, a); }, [&](int a) { return temperature[a]; });
  const Point<dim> rise = Eigen::Map<const Point<dim>>(found.data());
  EXPECT_LT((flux<dim>(Tensor<dim>(3.1 * Tensor<dim>::Identity()), rise) + 3.1 * gradient).norm(), 1e-12);
}

TYPED_TEST(BlockConduction, StiffnessIsExactlySymmetricWithoutFlowAtUniformTemperature) {
  constexpr int dim = TypeParam::value;
  const CornerMatrix<dim> stiffness = element_conductance<dim>(crooked<dim>(), 3.1 * Tensor<dim>::Identity());
  EXPECT_EQ(stiffness, stiffness.transpose());
  EXPECT_LT(stiffness.rowwise().sum().cwiseAbs().maxCoeff(), 1e-15 * stiffness.norm());
}

TYPED_TEST(BlockConduction, CornersShareTheWholeCapacity) {
  constexpr int dim = TypeParam::value;
  const auto mesh = test::slab_mesh<dim>({test::bar<dim>(2, 3, 2, 0.5)});
  const HeatModel model = make_heat_model(mesh, test::rock_only(), {}, test::options_for(mesh, 300));
  const double slab_volume = 2 * (dim == 2 ? 0.5 : 0.25);
  EXPECT_NEAR(model.capacity.sum() / (2500 * 800 * slab_volume), 1, 1e-13);
}

}  // namespace
}  // namespace scree::thermal
