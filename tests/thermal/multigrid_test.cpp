// Conjugate gradients with multigrid: the same temperatures as by Cholesky, no heat lost, no bit that depends on threads.
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "engine/base/threads.h"
#include "engine/mesh/make_blocks.h"
#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"
#include "thermal/heat_solver.h"
#include "thermal/steady_state.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {
namespace {

// Four cubes in a row, the first warmer than the others.
mesh::BlockMesh<3> row_of_cubes(int cells) {
  std::vector<test::Slab<3>> slabs;
  for (int i = 0; i < 4; ++i) {
    test::Slab<3> slab;
    slab.low = Point<3>(0.1 * i, 0, 0);
    slab.size.setConstant(0.1);
    slab.cells.fill(cells);
    slabs.push_back(slab);
  }
  return test::slab_mesh(slabs);
}

HeatModel joined(const mesh::BlockMesh<3>& mesh, double stiffness_factor, bool held,
                 const Table<MaterialId, Material>& materials = test::rock_only()) {
  HeatOptions options = test::options_for(mesh, 300);
  options.initial_temperature[BodyId{0}] = 400.0;
  options.joint.law = StiffnessFactor{stiffness_factor};
  if (held) {
    Boundary end;
    end.region = Region(BodyId{3}, test::between_x(0.4, 0.4));
    end.condition = FixedTemperature{350.0};
    options.boundaries.push_back(end);
  }
  return make_heat_model(mesh, materials, test::matching_contacts(mesh), options);
}

HeatState heated(const HeatModel& model, LinearSolver solver) {
  TimeOptions options;
  options.until = 600;
  options.output_every = 600;
  options.tolerance = 0.5;
  options.integrator = Integrator::implicit;
  options.solver = solver;
  HeatRun run(model, options);
  run.advance_to(options.until);
  return run.state();
}

class Multigrids : public testing::TestWithParam<double> {};

TEST_P(Multigrids, GiveTheTemperaturesAndTheErrorEstimateOfCholesky) {
  const HeatModel model = joined(row_of_cubes(4), GetParam(), true);
  const HeatState exact = heated(model, LinearSolver::cholesky);
  const HeatState state = heated(model, LinearSolver::multigrid);
  EXPECT_EQ(state.steps, exact.steps);
  EXPECT_LT((state.temperature - exact.temperature).lpNorm<Eigen::Infinity>(), 1e-6);
  EXPECT_NEAR(state.time_error, exact.time_error, 1e-4 * exact.time_error);
  EXPECT_LT(state.ledger.relative_residual(), 1e-10);
}

TEST_P(Multigrids, KeepTheHeatOfAnInsulatedRow) {
  const HeatModel model = joined(row_of_cubes(4), GetParam(), false);
  const HeatState state = heated(model, LinearSolver::multigrid);
  const Eigen::VectorXd heat = model.capacity.cwiseProduct(state.temperature - model.initial);
  EXPECT_LT(std::abs(heat.sum()), 1e-10 * heat.lpNorm<1>());
}

TEST_P(Multigrids, FindTheSteadyStateOfCholesky) {
  const HeatModel model = joined(row_of_cubes(4), GetParam(), true);
  const HeatState state = find_steady_state(model, LinearSolver::multigrid).state;
  EXPECT_LT((state.temperature.array() - 350).abs().maxCoeff(), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Joints, Multigrids, testing::Values(0.01, 1.0, 1e3, 1e6, 1e9));

// k doubles over the row.
TEST(Multigrid, GivesTheTemperaturesAndTheErrorEstimateOfCholeskyWhereConductivitiesVary) {
  auto materials = test::rock_only();
  materials[MaterialId{0}].conductivity = Curve::from_table(LinearTable({300, 400}, {2, 4}));
  for (const double beta : {0.01, 1.0, 1e3, 1e6}) {
    const HeatModel model = joined(row_of_cubes(4), beta, true, materials);
    const HeatState exact = heated(model, LinearSolver::cholesky);
    const HeatState state = heated(model, LinearSolver::multigrid);
    EXPECT_EQ(state.steps, exact.steps) << beta;
    EXPECT_LT((state.temperature - exact.temperature).lpNorm<Eigen::Infinity>(), 1e-6) << beta;
    EXPECT_NEAR(state.time_error, exact.time_error, 1e-3 * exact.time_error) << beta;
    EXPECT_LT(state.ledger.relative_residual(), 1e-10) << beta;
  }
}

// MPI's own folders in it are shared by all programs of a user, and two that start and end at once would fall over them.
TEST(Multigrid, StartsWithoutAFolderForTemporaryFiles) {
  ASSERT_EQ(setenv("TMPDIR", "/proc/no such folder", 1), 0);
  const HeatModel model = joined(row_of_cubes(4), 1, true);
  const HeatState state = find_steady_state(model, LinearSolver::multigrid).state;
  EXPECT_LT((state.temperature.array() - 350).abs().maxCoeff(), 1e-7);
}

TEST(Multigrid, GivesTheSameBitsWhateverTheNumberOfThreads) {
  const HeatModel model = joined(row_of_cubes(10), 1000, true);
  ASSERT_GT(model.capacity.size(), rows_worth_sharing);
  const int before = threads_in_use();
  use_threads(1);
  const HeatState one = heated(model, LinearSolver::multigrid);
  use_threads(2);
  const HeatState two = heated(model, LinearSolver::multigrid);
  use_threads(before);
  EXPECT_TRUE((one.temperature.array() == two.temperature.array()).all());
  EXPECT_TRUE((one.error.array() == two.error.array()).all());
}

// Of the steady state of a cube of `cells` along each edge.
std::int64_t iterations(int cells) {
  const auto mesh = row_of_cubes(cells);
  const HeatModel model = joined(mesh, 1000, true);
  const FreeNodes free(model);
  Multigrid multigrid(model.conductance, free);
  multigrid.prepare(Eigen::VectorXd::Zero(free.size()), 1);
  const Eigen::VectorXd heat = Eigen::VectorXd::LinSpaced(free.size(), -1, 1);
  const Eigen::VectorXd solution = multigrid.solve(heat, 1e-8);
  EXPECT_TRUE(solution.allFinite());
  return multigrid.iterations();
}

TEST(Multigrid, TakesHardlyMoreIterationsForSixtyTimesAsManyUnknowns) {
  const std::int64_t few = iterations(4);
  EXPECT_LT(iterations(16), 2 * few);
  EXPECT_LT(few, 30);
}

TEST(CheaperSolver, IsCholeskyForAFewThousandUnknownsAndMultigridForAMillionOfASolid) {
  const auto chosen = [](double unknowns) {
    const FactorSize factor{6 * std::pow(unknowns, 4.0 / 3), 20 * unknowns * unknowns};
    return cheaper_solver(factor, static_cast<std::int64_t>(15 * unknowns), SolverUse{}).solver;
  };
  EXPECT_EQ(chosen(5e3), LinearSolver::cholesky);
  EXPECT_EQ(chosen(1e6), LinearSolver::multigrid);
}

TEST(CheaperSolver, IsMultigridWhereAFactorHasNoRoom) {
  const FactorSize thin_but_large{2e9, 1e6};
  EXPECT_EQ(cheaper_solver(thin_but_large, 1'000'000'000, use_of_steady_state).solver, LinearSolver::multigrid);
  const FactorSize impossible{0, 0, false};
  EXPECT_EQ(cheaper_solver(impossible, 1'000'000, use_of_steady_state).solver, LinearSolver::multigrid);
}

}  // namespace
}  // namespace scree::thermal
