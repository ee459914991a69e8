// The bar of Li & Feng (2016), section 2.1: 1 m long, 0 C, its ends held at 100 C and 0 C, against the series of eq. (14).
#include <cmath>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

constexpr double zero = 273.15;       // 0 C [K]
constexpr double diffusivity = 8e-3;  // kappa of eq. (14) [m2/s]

Table<MaterialId, Material> bar_material() {
  Material material;
  material.name = "bar";
  material.density = 1000;
  material.conductivity = 1.6;
  material.specific_heat = 0.2;
  return Table<MaterialId, Material>({material});
}

// Eq. (14) for a bar of length 1 m [C].
double series(double z, double time, double left, double right) {
  double temperature = left + z * (right - left);
  for (int n = 1; n < 400; ++n) {
    const double decay = std::exp(-diffusivity * n * n * M_PI * M_PI * time);
    temperature += 2 / M_PI * decay * (right * std::cos(n * M_PI) - left) / n * std::sin(n * M_PI * z);
  }
  return temperature;
}

template <int dim>
HeatModel bar_model(const mesh::BlockMesh<dim>& mesh) {
  HeatOptions options = test::options_for(mesh, zero);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, zero + 100, "hot end"));
  options.boundaries.push_back(test::hold(BodyId{0}, 1, zero, "cold end"));
  return make_heat_model(mesh, bar_material(), {}, options);
}

template <int dim>
double error_at(double time, int cells, double tolerance) {
  const auto mesh = test::slab_mesh<dim>({test::bar<dim>(1.0, cells, 1, 1.0 / cells)});
  TimeOptions options;
  options.until = time;
  options.tolerance = tolerance;
  HeatRun run(bar_model<dim>(mesh), options);
  run.advance_to(time);
  double largest = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    const double exact = zero + series(mesh.nodes[node][0], time, 100, 0);
    largest = std::max(largest, std::abs(run.state().temperature[node.value()] - exact));
  }
  return largest;
}

TEST(SlabSeries, ErrorFallsWithTheSquareOfTheMeshSize) {
  for (const int cells : {10, 20, 40}) {
    const double order2 = std::log2(error_at<2>(10, cells, 1e-3) / error_at<2>(10, 2 * cells, 1e-3));
    EXPECT_NEAR(order2, 2, 0.15) << cells;
  }
  const double order3 = std::log2(error_at<3>(10, 10, 1e-3) / error_at<3>(10, 20, 1e-3));
  EXPECT_NEAR(order3, 2, 0.15);
}

TEST(SlabSeries, ThePapersBarFollowsTheSeriesAtItsThreePoints) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(1.0, 100, 2, 0.02)});  // 400 triangles
  const HeatModel model = bar_model<2>(mesh);
  TimeOptions options;
  options.until = 150;
  options.output_every = 5;
  options.tolerance = 0.05;
  HeatRun run(model, options);
  for (int k = 1; k <= 30; ++k) {
    run.advance_to(5.0 * k);
    for (const NodeId node : mesh.nodes.ids()) {
      const double z = mesh.nodes[node][0];
      if (std::min({std::abs(z - 0.2), std::abs(z - 0.5), std::abs(z - 0.8)}) > 1e-9) continue;
      EXPECT_NEAR(run.state().temperature[node.value()], zero + series(z, 5.0 * k, 100, 0), 0.05 + 0.05) << z << " " << 5 * k;
    }
  }
  EXPECT_TRUE(run.within_tolerance());
}

}  // namespace
}  // namespace scree::thermal
