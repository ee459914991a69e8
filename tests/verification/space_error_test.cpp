// The estimate of the space error against the true distance of linear elements from smooth temperatures.
#include "thermal/space_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"

namespace scree::thermal {
namespace {

template <int dim>
mesh::BlockMesh<dim> cube(int cells, bool block_per_element = false) {
  test::Slab<dim> slab;
  slab.cells.fill(cells);
  slab.block_per_element = block_per_element;
  return test::slab_mesh<dim>({slab});
}

template <int dim, class Field>
Eigen::VectorXd at_nodes(const mesh::BlockMesh<dim>& mesh, const Field& field) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) values[node.value()] = field(mesh.nodes[node]);
  return values;
}

template <class Dim>
class SpaceErrorOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SpaceErrorOf, Dimensions);

TYPED_TEST(SpaceErrorOf, ALinearTemperatureIsNothing) {
  constexpr int dim = TypeParam::value;
  const auto mesh = cube<dim>(3);
  const auto linear = at_nodes<dim>(mesh, [](const Point<dim>& x) { return 300 + 10 * x[0] - 4 * x[1]; });
  const SpaceError error = estimate_space_error(mesh, test::rock_only(), linear, Eigen::VectorXd::Zero(linear.size()));
  EXPECT_LT(error.largest, 1e-9);
  EXPECT_LT(error.relative.value(), 1e-9);
}

TYPED_TEST(SpaceErrorOf, ASmoothTemperatureFallsWithTheSquareOfTheMesh) {
  constexpr int dim = TypeParam::value;
  std::vector<double> largest;
  for (const int cells : {4, 8}) {
    const auto mesh = cube<dim>(cells);
    const auto wave = at_nodes<dim>(mesh, [](const Point<dim>& x) { return 100 * std::sin(2 * x[0]) * std::cos(x[1]); });
    largest.push_back(estimate_space_error(mesh, test::rock_only(), wave, Eigen::VectorXd::Zero(wave.size())).largest);
  }
  EXPECT_NEAR(std::log2(largest[0] / largest[1]), 2, 0.3);
}

TYPED_TEST(SpaceErrorOf, ASmoothTemperatureIsFoundWithinAFactorOfThree) {
  constexpr int dim = TypeParam::value;
  const auto field = [](const Point<dim>& x) { return 100 * std::sin(2 * x[0]) * std::cos(x[1]); };
  const auto mesh = cube<dim>(8);
  const auto wave = at_nodes<dim>(mesh, field);
  const SpaceError error = estimate_space_error(mesh, test::rock_only(), wave, Eigen::VectorXd::Zero(wave.size()));
  double truth = 0;
  for (const ElementId e : mesh.elements.ids()) {
    const auto& corners = mesh.elements[e];
    for (int i = 0; i <= dim; ++i) {
      for (int j = 0; j < i; ++j) {
        const Point<dim> middle = (mesh.nodes[corners[i]] + mesh.nodes[corners[j]]) / 2;
        truth = std::max(truth, std::abs(field(middle) - (wave[corners[i].value()] + wave[corners[j].value()]) / 2));
      }
    }
  }
  EXPECT_GT(error.largest, truth / 3);
  EXPECT_LT(error.largest, truth * 3);
}

// What T misses between its nodes is T's alone, whatever carries the heat along the other axes.
TYPED_TEST(SpaceErrorOf, ASmoothTemperatureIsFoundWhereTheConductivityAlongItIsTheLeast) {
  constexpr int dim = TypeParam::value;
  const auto mesh = cube<dim>(8);
  const auto wave = at_nodes<dim>(mesh, [](const Point<dim>& x) { return 100 * std::sin(3 * x[1]); });
  const auto still = Eigen::VectorXd::Zero(wave.size());
  const double isotropic = estimate_space_error(mesh, test::rock_only(), wave, still).largest;
  Material rock = test::rock();
  rock.conductivity->ratio = {100, 1, 100};
  const double along = estimate_space_error(mesh, Table<MaterialId, Material>({rock}), wave, still).largest;
  EXPECT_NEAR(along / isotropic, 1, 1e-6);
}

TYPED_TEST(SpaceErrorOf, ABlockOfOneElementIsSeenByItsHeatBalance) {
  constexpr int dim = TypeParam::value;
  const auto mesh = cube<dim>(2, true);
  const auto uniform = at_nodes<dim>(mesh, [](const Point<dim>&) { return 300.0; });
  const double rate = 0.01;  // [K/s]
  const SpaceError error =
      estimate_space_error(mesh, test::rock_only(), uniform, Eigen::VectorXd::Constant(uniform.size(), rate));
  EXPECT_FALSE(error.relative) << "one element cannot be smoothed";
  for (const ElementId e : mesh.elements.ids()) {
    const double h = mesh::element_mean_edge(mesh, e);
    EXPECT_NEAR(error.of_element[e.index()], 2500 * 800 * rate * h * h / (8 * 4.0), 1e-9);
  }
}

}  // namespace
}  // namespace scree::thermal
