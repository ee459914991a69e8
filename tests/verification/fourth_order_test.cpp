// Space of fourth order (thermal/fourth_order.h) against exact solutions.
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "engine/mesh/cells.h"
#include "engine/mesh/make_blocks.h"
#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/fourth_order.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

constexpr double capacity = 2500.0 * 880.0;  // [J/m3/K]

// A box of 1 by 0.8 by 0.6 m with `cells` cells along each of its edges, so that none is a cube.
template <int dim>
mesh::BlockMesh<dim> bricks(int cells) {
  mesh::BodySpec body;
  body.name = "box";
  body.shape = mesh::Box{.size = Eigen::Vector3d::Ones()};
  body.mesh_size = 1.0 / cells;
  body.cells = dim == 3 ? mesh::CellKind::hexahedron : mesh::CellKind::quadrilateral;
  body.material = MaterialId{0};
  auto mesh = mesh::make_blocks<dim>({body});
  for (Point<dim>& node : mesh.nodes) {
    node = (node.array() + 0.5).matrix().cwiseProduct(Eigen::Vector3d(1, 0.8, 0.6).head<dim>());
  }
  return mesh;
}

// Conductivities along the axes [W/m/K].
Table<MaterialId, Material> rock(const Eigen::Vector3d& conductivity) {
  Material material;
  material.name = "rock";
  material.density = 2500;
  material.specific_heat = 880;
  material.conductivity = Conductivity(1.0);
  material.conductivity->ratio = conductivity;
  return Table<MaterialId, Material>({material});
}

TimeOptions until(double time, double tolerance) {
  TimeOptions options;
  options.until = time;
  options.tolerance = tolerance;
  return options;
}

HeatOptions fourth(HeatOptions options) {
  options.space_order = SpaceOrder::fourth;
  return options;
}

// A product of cosines that decays in the insulated box: the largest error at a node after it has fallen to about a third.
template <int dim>
double decay_error(int cells, const Eigen::Vector3d& conductivity) {
  const auto mesh = bricks<dim>(cells);
  const Eigen::Vector3d wave = M_PI * Eigen::Vector3d(1, 2 / 0.8, 1 / 0.6);
  double rate = 0;
  for (int i = 0; i < dim; ++i) rate += conductivity[i] * wave[i] * wave[i] / capacity;
  const auto mode = [&](const Point<dim>& at) {
    double value = 100;
    for (int i = 0; i < dim; ++i) value *= std::cos(wave[i] * at[i]);
    return value;
  };
  HeatOptions options = fourth(test::options_for(mesh, 300));
  options.initial_field.emplace(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) (*options.initial_field)[node.value()] = 300 + mode(mesh.nodes[node]);
  HeatRun run(make_heat_model(mesh, rock(conductivity), {}, options), until(1 / rate, 1e-4));
  run.advance_to(1 / rate, {});
  double worst = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    worst = std::max(worst, std::abs(run.state().temperature[node.value()] - 300 - std::exp(-1.0) * mode(mesh.nodes[node])));
  }
  return worst;
}

template <int dim>
void expect_fourth_order(const Eigen::Vector3d& conductivity) {
  const double coarse = decay_error<dim>(8, conductivity), fine = decay_error<dim>(16, conductivity);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.25) << coarse << " and " << fine;
}

TEST(FourthOrder, TheErrorOfADecayingWaveInBricksFallsWithTheFourthPowerOfTheMeshSize) {
  expect_fourth_order<2>({3.1, 3.1, 3.1});
  expect_fourth_order<3>({3.1, 3.1, 3.1});
}

TEST(FourthOrder, SoItDoesWhereTheConductivityDiffersAlongTheAxes) {
  expect_fourth_order<3>({3.1, 1.2, 0.4});
}

// The box insulated, with sources of the same cosines until they are worth 1 - 1/e of what they come to.
double source_error(int cells) {
  const auto mesh = bricks<2>(cells);
  const double x = M_PI, y = 2 * M_PI / 0.8, rate = 3.1 * (x * x + y * y) / capacity;
  HeatOptions options = fourth(test::options_for(mesh, 300));
  Source source;
  source.region = test::on(BodyId{0});
  source.power = test::formula(fmt::format("{:.17g}*cos({:.17g}*x)*cos({:.17g}*y)", 100 * rate * capacity, x, y));
  source.name = "source";
  options.sources.push_back(source);
  HeatRun run(make_heat_model(mesh, rock({3.1, 3.1, 3.1}), {}, options), until(1 / rate, 1e-4));
  run.advance_to(1 / rate, {});
  double worst = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    const Point<2>& at = mesh.nodes[node];
    const double exact = 300 + 100 * (1 - std::exp(-1.0)) * std::cos(x * at.x()) * std::cos(y * at.y());
    worst = std::max(worst, std::abs(run.state().temperature[node.value()] - exact));
  }
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
  return worst;
}

TEST(FourthOrder, SoDoesTheErrorOfASourceThatVariesInPlace) {
  const double coarse = source_error(8), fine = source_error(16);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.3) << coarse << " and " << fine;
}

// The whole space from x = 0 on, heated there by 75 K from t = 0, as far as the box reaches in this time.
double heated(double x, double time) {
  return 25 + 75 * std::erfc(x / (2 * std::sqrt(3.1 / capacity * time)));
}

Boundary held_at(double x, double temperature) {
  const Aabb<3> end(Eigen::Vector3d(x, -1, -1), Eigen::Vector3d(x, 2, 2));
  return {Region(BodyId{0}, end), FixedTemperature{temperature}, "end", {}};
}

struct Heating {
  double error;     // largest at a node [K]
  double residual;  // of the ledger, over its turnover [-]
  double supplied;  // over what the exact solution takes up [-]
};

Heating sudden_heating(int cells) {
  constexpr double time = 7200;
  const auto mesh = bricks<2>(cells);
  HeatOptions options = fourth(test::options_for(mesh, 25));
  options.boundaries = {held_at(0, 100)};
  const HeatModel model = make_heat_model(mesh, rock({3.1, 3.1, 3.1}), {}, options);
  HeatRun run(model, until(time, 1e-4));
  run.advance_to(time, {});
  const Ledger& ledger = run.state().ledger;
  Heating result{0, ledger.relative_residual(), 0};
  for (const NodeId node : mesh.nodes.ids()) {
    result.error = std::max(result.error, std::abs(run.state().temperature[node.value()] - heated(mesh.nodes[node].x(), time)));
  }
  const double taken = 0.8 * capacity * 75 * 2 * std::sqrt(3.1 / capacity * time / M_PI);
  result.supplied = (ledger.start_jump + ledger.by_boundary[0]) / taken;
  return result;
}

TEST(FourthOrder, ASuddenStartIsResolvedInFourthOrderToo) {
  const Heating coarse = sudden_heating(12), fine = sudden_heating(24);
  EXPECT_NEAR(std::log2(coarse.error / fine.error), 4, 0.5) << coarse.error << " and " << fine.error;
}

// A uniform weight for each node's half cells integrates over a boundary layer in second order.
TEST(FourthOrder, TheLedgerClosesAndTheHeatThatAHoldBringsInIsOfSecondOrder) {
  const Heating coarse = sudden_heating(12), fine = sudden_heating(24);
  EXPECT_LT(coarse.residual, 1e-12);
  EXPECT_LT(fine.residual, 1e-12);
  EXPECT_NEAR(std::log2((coarse.supplied - 1) / (fine.supplied - 1)), 2, 0.1) << coarse.supplied << ", " << fine.supplied;
}

TEST(FourthOrder, WhatNodesShareIsSymmetricAndNothingInAll) {
  const auto mesh = bricks<3>(4);
  const HeatModel model = make_heat_model(mesh, rock({3, 2, 1}), {}, fourth(test::options_for(mesh, 300)));
  const SparseMatrix transposed = model.shared_capacity->transpose();
  EXPECT_EQ((*model.shared_capacity - transposed).norm(), 0);
  EXPECT_LT((transposed * Eigen::VectorXd::Ones(transposed.cols())).norm(), 1e-12 * model.capacity.norm());
  EXPECT_GT(transposed.norm(), 0.1 * model.capacity.norm());
  const SparseMatrix other_way = model.conductance.transpose();
  EXPECT_EQ((model.conductance - other_way).norm(), 0);
}

// Faces that are not plane, and no cell like another.
TEST(FourthOrder, AUniformGradientIsExactInDistortedCells) {
  auto mesh = bricks<3>(4);
  int count = 0;
  for (Point<3>& node : mesh.nodes) {
    ++count;
    node += 0.02 * Point<3>(std::sin(1.0 + 7 * count), std::sin(2.0 + 5 * count), std::sin(3.0 * count));
  }
  const HeatModel model = make_heat_model(mesh, rock({1, 1, 1}), {}, fourth(test::options_for(mesh, 300)));
  const Point<3> gradient(3, -1, 2);
  Eigen::VectorXd temperature(model.capacity.size()), inflow = Eigen::VectorXd::Zero(model.capacity.size());
  for (const NodeId node : mesh.nodes.ids()) temperature[node.value()] = gradient.dot(mesh.nodes[node]);
  for (const auto& face : mesh::weighted_faces(mesh)) {
    const Point<3> u = mesh.nodes[face.nodes[1]] - mesh.nodes[face.nodes[0]],
                   v = mesh.nodes[face.nodes[2]] - mesh.nodes[face.nodes[0]];
    for (const NodeId node : face.nodes) inflow[node.value()] += face.weight * gradient.dot(0.5 * u.cross(v)) / 3;
  }
  const Eigen::VectorXd balance = model.conductance * temperature - inflow;
  for (const NodeId node : mesh.nodes.ids()) {  // what passes a face that is not plane is another matter
    const Point<3>& at = mesh.nodes[node];
    const bool inside = (at.array() > 0.05).all() && (at.array() < Point<3>(0.95, 0.75, 0.55).array()).all();
    if (inside) {
      EXPECT_NEAR(balance[node.value()], 0, 1e-12);
    }
  }
}

mesh::BodySpec square(const std::string& name) {
  mesh::BodySpec body;
  body.name = name;
  body.shape = mesh::Box{.size = Eigen::Vector3d::Ones()};
  body.mesh_size = 0.125;
  body.cells = mesh::CellKind::quadrilateral;
  body.material = MaterialId{0};
  return body;
}

TEST(FourthOrder, AJointPassesHeatWithoutLosingAny) {
  auto mesh = mesh::make_blocks<2>({square("left"), square("right")});
  for (const NodeId node : mesh.blocks[BlockId{1}].nodes) mesh.nodes[node].x() += 1;
  HeatOptions options = fourth(test::options_for(mesh, 300));
  options.initial_temperature[BodyId{1}] = 400.0;
  options.joint.law = JointConductance{50};
  const auto contacts = contact::find_contacts(mesh, {});
  const HeatModel model = make_heat_model(mesh, rock({3, 3, 3}), contacts, options);
  ASSERT_FALSE(contacts.contacts.empty());
  HeatRun run(model, until(1e5, 0.01));
  run.advance_to(1e5, {});
  EXPECT_NEAR(model.capacity.dot(run.state().temperature) / model.capacity.sum(), 350, 1e-10);
  EXPECT_GT(run.state().temperature.minCoeff(), 300);
  EXPECT_LT(run.state().temperature.maxCoeff(), 400);
  EXPECT_GT(run.state().temperature[0], 301);
}

// The rule that is broken; nothing if none is.
template <int dim>
std::string refused(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options) {
  try {
    const HeatModel model = make_heat_model(mesh, rock({1, 1, 1}), {}, options);
    HeatRun(model, options.time);
  } catch (const InputError& error) {
    return error.problems()[0].key + ": " + error.problems()[0].rule;
  }
  return {};
}

TEST(FourthOrder, WhatItCannotDoIsRefused) {
  const auto grid = bricks<2>(4);
  HeatOptions options = fourth(test::options_for(grid, 300));
  options.time = until(10, 0.1);
  EXPECT_EQ(refused(grid, options), "");
  options.time.integrator = Integrator::implicit;
  EXPECT_NE(refused(grid, options).find("heat.space_order: must be done in stabilised explicit steps"), std::string::npos);
  test::Slab<2> slab;
  slab.cells = {2, 2};
  const auto triangles = test::slab_mesh<2>({slab});
  auto folded = bricks<2>(1);
  folded.nodes[folded.cells[CellId{0}].nodes[2]] = 0.1 * folded.nodes[folded.cells[CellId{0}].nodes[2]];
  EXPECT_NE(refused(folded, fourth(test::options_for(folded, 300))).find("fold over"), std::string::npos);
  EXPECT_NE(refused(triangles, fourth(test::options_for(triangles, 300))).find("blocks of quadrilaterals"), std::string::npos);
}

}  // namespace
}  // namespace scree::thermal
