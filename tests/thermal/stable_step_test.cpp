#include "thermal/stable_step.h"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "engine/mesh/make_blocks.h"
#include "tests/thermal/builders.h"
#include "tests/thermal/grids.h"
#include "thermal/drive.h"
#include "thermal/heat_balance.h"

namespace scree::thermal {
namespace {

// Elements of 2 cm, each its own block, the nodes out of place so that no two are alike; the left end is hot, the right one
// convects.
template <int dim>
HeatModel rubble(double beta) {
  auto slab = test::bar<dim>(0.08, 4, 2, 0.04);
  slab.block_per_element = true;
  auto mesh = test::slab_mesh<dim>({slab});
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shift(-3e-3, 3e-3);
  HeatOptions options = test::options_for(mesh, 298.15);
  options.joint.law = StiffnessFactor{beta};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 373.15, "left"));
  options.boundaries.push_back({test::on(BodyId{0}, test::between_x(0.08, 0.08)), Convection{30, 280}, "right", {}});
  const auto contacts = test::matching_contacts(mesh);
  for (const NodeId node : mesh.nodes.ids()) {
    if (mesh.nodes[node].x() > 1e-6 && mesh.nodes[node].x() < 0.08 - 1e-6) mesh.nodes[node][0] += shift(generator);
  }
  return make_heat_model(mesh, test::rock_only(), contacts, options);
}

// Of C^-1 M among the free nodes, M symmetric.
double largest_eigenvalue(const HeatModel& model, const Eigen::MatrixXd& matrix) {
  Eigen::VectorXd root = model.capacity.cwiseInverse().cwiseSqrt();
  for (const NodeId node : model.fixed_nodes) root[node.value()] = 0;
  const Eigen::MatrixXd scaled = root.asDiagonal() * matrix * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

template <int dim>
void expect_largest_eigenvalues(double beta) {
  const HeatModel model = rubble<dim>(beta);
  ASSERT_EQ(model.exchanges.size(), 1U);
  Eigen::MatrixXd matrix(model.conductance);
  matrix.diagonal() += loss_to_surroundings(model, model.initial, Drives(model).at(0));
  const double bound = 2 / stable_step(model).step;
  EXPECT_GE(bound, (1 - 1e-12) * largest_eigenvalue(model, matrix)) << beta;
  const double of_magnitudes = largest_eigenvalue(model, matrix.cwiseAbs());
  EXPECT_GE(bound, (1 - 1e-12) * of_magnitudes) << beta;
  EXPECT_LE(bound, 1.03 * of_magnitudes) << beta;
}

TEST(StableStep, IsThatOfTheLargestEigenvalueOfTheMagnitudesHoweverStiffTheJoints) {
  for (const double beta : {1e-3, 0.1, 10.0, 1e3, 1e9}) {
    expect_largest_eigenvalues<2>(beta);
    expect_largest_eigenvalues<3>(beta);
  }
}

// Of a grid the bound by its cells is the largest eigenvalue itself: all corners of all cells move against each other. In
// fourth order the operator is C^-1 (I + B C^-1) K, the eigenvalues of which are those of a symmetric matrix, too.
TEST(StableStep, OfAGridOfEqualBoxesIsThatOfTheFastestModeItself) {
  for (const Eigen::Vector3d& size : {Eigen::Vector3d(0.4, 0.4, 0.4), Eigen::Vector3d(0.31, 0.4, 0.47)}) {
    for (const SpaceOrder order : {SpaceOrder::second, SpaceOrder::fourth}) {
      const auto mesh = test::boxes_of_hexahedra(size, 0.1);
      HeatOptions options = test::options_for(mesh, 300);
      options.space_order = order;
      const HeatModel model = make_heat_model<3>(mesh, test::rock_only(), {}, options);
      Eigen::MatrixXd matrix(model.conductance);
      if (order == SpaceOrder::fourth) {
        const Eigen::MatrixXd sharing = Eigen::MatrixXd(*model.shared_capacity) * model.capacity.cwiseInverse().asDiagonal();
        matrix += sharing * matrix;
        EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-9 * matrix.norm());  // the two commute in a grid
      }
      EXPECT_NEAR(2 / stable_step(model).step / largest_eigenvalue(model, matrix), 1, 1e-9);
    }
  }
}

TEST(StableStep, OfAGridWithJointsOrUnevenCellsOwesNothingToItsCells) {
  auto mesh = test::boxes_of_hexahedra({0.4, 0.4, 0.4}, 0.1);
  mesh.nodes[NodeId{0}].x() -= 1e-3;
  EXPECT_FALSE(make_heat_model<3>(mesh, test::rock_only(), {}, test::options_for(mesh, 300)).fastest_cell);
  test::Slab<2> loose;
  loose.cells = {2, 2};
  loose.block_per_element = true;
  const auto joined = test::slab_mesh<2>({loose});
  EXPECT_FALSE(make_heat_model<2>(joined, test::rock_only(), test::matching_contacts(joined), test::options_for(joined, 300))
                   .fastest_cell);
}

// Right triangles conduct along their legs only: the five-point stencil, whose explicit steps are stable up to h^2/4a.
TEST(StableStep, OfASquareGridIsTheTextbooks) {
  mesh::BodySpec body;
  body.name = "plate";
  body.shape = mesh::Box{.size = Eigen::Vector3d(1, 1, 0)};
  body.mesh_size = 0.1;
  body.cells = mesh::CellKind::quadrilateral;
  body.material = MaterialId{0};
  const auto mesh = mesh::make_blocks<2>({body});
  const auto rock = test::rock_only();
  const HeatModel model = make_heat_model<2>(mesh, rock, {}, test::options_for(mesh, 300));
  const Material& of = rock[MaterialId{0}];
  const double diffusivity = *of.conductivity->value.constant() / (*of.density * *of.specific_heat->constant());
  EXPECT_NEAR(stable_step(model).step * diffusivity, 0.1 * 0.1 / 4, 1e-12);
}

}  // namespace
}  // namespace scree::thermal
