// Bad elements and large contrasts: the answer must be right all the same.
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/joint_conduction.h"

namespace scree::thermal {
namespace {

using Vector = Eigen::VectorXd;

// A cube of 3 x 3 x 3 cells whose inner layer at x = 1/3 is moved until its cells are `thin` thick: slivers and needles.
mesh::BlockMesh<3> squeezed_cube(double thin) {
  auto slab = test::bar<3>(1, 3, 3, 1);
  auto mesh = test::slab_mesh<3>({slab});
  for (const NodeId node : mesh.nodes.ids()) {
    double& x = mesh.nodes[node][0];
    if (std::abs(x - 1.0 / 3) < 1e-9) x = 2.0 / 3 - thin;
  }
  return mesh;
}

HeatOptions held_at_both_ends(const mesh::BlockMesh<3>& mesh, double left, double right) {
  HeatOptions options = test::options_for(mesh, left);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, left, "left"));
  options.boundaries.push_back(test::hold(BodyId{0}, 1, right, "right"));
  return options;
}

TimeOptions until(double time) {
  TimeOptions options;
  options.until = time;
  return options;
}

class BadElements : public testing::TestWithParam<double> {};

TEST_P(BadElements, PassALinearTemperature) {
  const auto mesh = squeezed_cube(GetParam());
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<3>{}, held_at_both_ends(mesh, 300, 400));
  HeatRun run(model, until(1e9));
  run.advance_to(1e9);
  for (const NodeId node : mesh.nodes.ids()) {
    EXPECT_NEAR(run.state().temperature[node.value()], 300 + 100 * mesh.nodes[node][0], 1e-6) << "thin " << GetParam();
  }
}

TEST_P(BadElements, KeepTheHeatOfAnInsulatedBody) {
  const auto mesh = squeezed_cube(GetParam());
  HeatOptions options = test::options_for(mesh, 300);
  options.sources.push_back({test::on(BodyId{0}, test::between_x(0, 0.3)), 1e4, "source", {}});
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contact::ContactSet<3>{}, options);
  HeatRun run(model, until(3600));
  run.advance_to(3600);
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
  EXPECT_LE(run.state().time_error, 0.1);
}

// Slivers of 1e-3 and 1e-6 of the cell's width, and one 1e4 times thinner than its neighbour.
INSTANTIATE_TEST_SUITE_P(Thin, BadElements, testing::Values(0.3e-3, 0.3e-6, 0.67e-4));

// Two slabs, continuous at x = 1/2, conductivities or capacities 1e6 apart.
struct Contrast {
  double conductivity;
  double heat;
};

class Contrasts : public testing::TestWithParam<Contrast> {};

TEST_P(Contrasts, OfMaterialsGiveTheSteadyTemperatureOfResistancesInSeries) {
  auto left = test::bar<2>(0.5, 8, 2, 0.1);
  auto right = left;
  right.low[0] = 0.5;
  right.material = MaterialId{1};
  const auto mesh = test::slab_mesh<2>({left, right});
  auto materials = test::rock_only();
  materials.push_back(test::rock());
  const double k = 4 * GetParam().conductivity;
  materials[MaterialId{1}].conductivity = k;
  materials[MaterialId{1}].specific_heat = 800 * GetParam().heat;
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 400, "left"));
  options.boundaries.push_back(test::hold(BodyId{1}, 1, 300, "right"));
  const auto contacts = test::matching_contacts(mesh);
  const HeatModel model = make_heat_model(mesh, materials, contacts, options);
  HeatRun run(model, until(1e13));
  run.advance_to(1e13);
  double joint = 0;
  for (const double g : joint_conduction(mesh, materials, contacts, options.joint).conductances) joint += g;
  const double flow = 100 / (0.5 / (4 * 0.1) + 1 / joint + 0.5 / (k * 0.1));
  for (const NodeId node : mesh.nodes.ids()) {
    const double x = mesh.nodes[node][0];
    const bool first = model.blocks[node] == BlockId{0};
    const double expected = first ? 400 - flow * x / (4 * 0.1) : 300 + flow * (1 - x) / (k * 0.1);
    EXPECT_NEAR(run.state().temperature[node.value()], expected, 1e-5) << "x " << x;
  }
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Million, Contrasts,
                         testing::Values(Contrast{1e6, 1}, Contrast{1e-6, 1}, Contrast{1, 1e6}, Contrast{1, 1e-6}));

}  // namespace
}  // namespace scree::thermal
