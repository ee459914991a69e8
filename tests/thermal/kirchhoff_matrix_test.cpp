// Balances whose conductivities depend on temperature, solved by means of a symmetric matrix: beside dense LU of all of J.
#include "thermal/kirchhoff_matrix.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "engine/base/threads.h"
#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/conjugate_residuals.h"
#include "thermal/drive.h"
#include "thermal/heat_solver.h"

namespace scree::thermal {
namespace {

Material rock_of(const Conductivity& conductivity) {
  Material rock = test::rock();
  rock.conductivity = conductivity;
  return rock;
}

// Four cubes in a row: two of rock that conducts better the hotter it is, one that conducts worse, one constant.
HeatModel row_of_cubes(double stiffness_factor) {
  std::vector<test::Slab<3>> slabs;
  const int materials[] = {0, 0, 1, 2};
  for (int i = 0; i < 4; ++i) {
    test::Slab<3> slab = test::bar<3>(0.1, 3, 3, 0.1);
    slab.low[0] = 0.1 * i;
    slab.material = MaterialId(static_cast<std::size_t>(materials[i]));
    slabs.push_back(slab);
  }
  const auto mesh = test::slab_mesh<3>(slabs);
  HeatOptions options = test::options_for(mesh, 300);
  options.joint.law = StiffnessFactor{stiffness_factor};
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 900, "hot"));
  Boundary end = test::hold(BodyId{3}, 0.4, 0, "wind");
  end.condition = Convection{20, 280};
  options.boundaries.push_back(end);
  const Table<MaterialId, Material> rocks({rock_of(test::curve("1 + 0.01*T")), rock_of(test::curve("1000/T")), rock_of(2.0)});
  return make_heat_model(mesh, rocks, test::matching_contacts(mesh), options);
}

HeatModel alone() {
  const auto mesh = test::slab_mesh<3>({test::bar<3>(0.1, 4, 3, 0.1)});
  HeatOptions options = test::options_for(mesh, 300);
  return make_heat_model(mesh, Table<MaterialId, Material>({rock_of(test::curve("1 + 0.01*T"))}), {}, options);
}

// From 900 to 300 K along x, uneven from node to node.
Linearised state_of(const HeatModel& model) {
  Eigen::VectorXd temperature = 900 - 1500 * model.places.row(0).transpose().array();
  for (Eigen::Index i = 0; i < temperature.size(); ++i) temperature[i] += 5 * std::sin(1.0 + static_cast<double>(i));
  return HeatBalance(model).linearised(temperature, Drives(model).at(0));
}

Eigen::MatrixXd conduction(const HeatModel& model, const Linearised& at) {
  return Eigen::MatrixXd(model.conductance) + Eigen::MatrixXd(model.varying->unit_conductance) * at.conductivity.asDiagonal();
}

TEST(KirchhoffMatrix, OfASingleMaterialWithoutJointsIsThatOfTheBalanceInAnotherVariable) {
  const HeatModel model = alone();
  const Linearised at = state_of(model);
  KirchhoffMatrix matrix(model);
  matrix.set(at.conductivity);
  const Eigen::MatrixXd exact = conduction(model, at) * matrix.per_variable().asDiagonal();
  EXPECT_LT((Eigen::MatrixXd(matrix.near()) - exact).cwiseAbs().maxCoeff(), 1e-13 * exact.cwiseAbs().maxCoeff());
  EXPECT_GT((conduction(model, at) - conduction(model, at).transpose()).cwiseAbs().maxCoeff(),
            0.01 * exact.cwiseAbs().maxCoeff());
}

TEST(KirchhoffMatrix, IsSymmetricAndPositiveSemidefiniteAndKeepsItsPattern) {
  for (const double beta : {0.1, 1e3, 1e7}) {
    const HeatModel model = row_of_cubes(beta);
    KirchhoffMatrix matrix(model);
    const Eigen::Index entries = matrix.near().nonZeros();
    matrix.set(state_of(model).conductivity);
    EXPECT_EQ(matrix.near().nonZeros(), entries);
    const Eigen::MatrixXd near(matrix.near());
    EXPECT_LT((near - near.transpose()).cwiseAbs().maxCoeff(), 1e-15 * near.cwiseAbs().maxCoeff());
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(near).eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff()) << beta;
  }
}

TEST(KirchhoffMatrix, ConductsAsTheBalanceDoes) {
  const HeatModel model = row_of_cubes(10);
  const Linearised at = state_of(model);
  KirchhoffMatrix matrix(model);
  matrix.set(at.conductivity);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(model.capacity.size(), -1, 1);
  const Eigen::VectorXd exact = conduction(model, at) * x;
  EXPECT_LT((matrix.conducted(x) - exact).norm(), 1e-12 * exact.norm());
}

// A right side of a row of cubes, and what it is solved to.
struct Row {
  explicit Row(double stiffness_factor) : model(row_of_cubes(stiffness_factor)) {}

  // By the dense matrix of the free nodes; capacities count unless the state is steady.
  [[nodiscard]] Eigen::VectorXd solution(const Linearised& state, double scale, bool steady) const {
    Eigen::MatrixXd all = scale * conduction(model, state);
    all.diagonal() += scale * state.loss;
    if (!steady) all.diagonal() += state.capacity;
    const Eigen::MatrixXd columns = free.gather(all).transpose();
    return Eigen::MatrixXd(free.gather(columns).transpose()).fullPivLu().solve(rhs);
  }

  HeatModel model;
  FreeNodes free{model};
  Linearised at = state_of(model);
  Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(free.size(), -1, 2);
};

class UnsymmetricSolves : public testing::TestWithParam<LinearSolver> {
 protected:
  static HeatSolver solver_of(const Row& row) { return {row.model, row.free, GetParam(), SolverUse{}}; }
  static double off(const Eigen::VectorXd& solution, const Eigen::VectorXd& exact) {
    return (solution - exact).norm() / exact.norm();
  }
};

TEST_P(UnsymmetricSolves, AreThoseOfDenseLu) {
  for (const double beta : {0.1, 10.0, 1e3, 1e6}) {
    const Row row(beta);
    HeatSolver solver = solver_of(row);
    for (const double scale : {1.0, 1e3, 1e6}) {
      const Eigen::VectorXd exact = row.solution(row.at, scale, false);
      solver.prepare(row.at, scale);
      EXPECT_LT(off(solver.solve(row.rhs), exact), 1e-8) << beta << " " << scale;
      EXPECT_LT(off(solver.estimate(row.rhs), exact), 5e-4) << beta << " " << scale;
      EXPECT_LT(off(solver.correction(row.rhs), exact), 5e-3) << beta << " " << scale;
    }
    solver.prepare_steady(row.at);
    EXPECT_LT(off(solver.solve(row.rhs), row.solution(row.at, 1, true)), 1e-7) << beta;
  }
}

TEST_P(UnsymmetricSolves, OfSteadyStatesAreExactWithAMatrixNearThatIsKeptWhileLittleChanges) {
  const Row row(1e3);
  HeatSolver solver = solver_of(row);
  const std::vector<std::pair<double, std::int64_t>> changes{{0, 1}, {0.09, 1}, {0.12, 2}, {0.15, 2}};
  for (const auto& [change, matrices] : changes) {
    Linearised at = row.at;
    for (Eigen::Index i = 0; i < at.conductivity.size(); i += 2) at.conductivity[i] *= 1 + change;
    solver.prepare_steady(at);
    EXPECT_EQ(solver.factorisations(), matrices) << change;
    EXPECT_LT(off(solver.solve(row.rhs), row.solution(at, 1, true)), 1e-7) << change;
  }
}

TEST_P(UnsymmetricSolves, GiveTheSameBitsOnHoweverManyThreads) {
  const Row row(1e3);
  const auto solution = [&](int threads) {
    const int before = threads_in_use();
    use_threads(threads);
    HeatSolver solver = solver_of(row);
    solver.prepare(row.at, 100);
    const Eigen::VectorXd result = solver.solve(row.rhs);
    use_threads(before);
    return result;
  };
  EXPECT_EQ(solution(2), solution(1));
}

INSTANTIATE_TEST_SUITE_P(By, UnsymmetricSolves, testing::Values(LinearSolver::cholesky, LinearSolver::multigrid),
                         [](const auto& solver) { return solver.param == LinearSolver::cholesky ? "Cholesky" : "Multigrid"; });

// Rows and columns of size one with what is off the diagonal up to `off`.
struct Equations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd rhs, solution;
};
Equations equations(double off) {
  constexpr int size = 40;
  Equations all;
  all.matrix = Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) all.matrix(i, j) += off / size * std::sin(1 + 7.0 * i + 3.0 * j * j);
  }
  all.solution = Eigen::VectorXd::LinSpaced(size, -1, 3);
  all.rhs = all.matrix * all.solution;
  return all;
}

TEST(ConjugateResiduals, SolveToTheAccuracyThatIsAskedFor) {
  for (const double off : {0.0, 0.1, 1.0, 10.0}) {
    const Equations all = equations(off);
    for (const double accuracy : {1e-2, 1e-6, 1e-10}) {
      const Eigen::VectorXd found =
          conjugate_residuals([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return all.matrix * x; },
                              [](const Eigen::VectorXd& b) -> Eigen::VectorXd { return b; }, all.rhs, accuracy);
      EXPECT_LT((found - all.solution).norm(), 3 * accuracy * all.solution.norm()) << off << " " << accuracy;
    }
  }
}

TEST(ConjugateResiduals, AskForTwoSolvesWhereTheMatrixNearIsVeryNear) {
  const Equations all = equations(1);
  const Eigen::MatrixXd near = (all.matrix + 1e-5 * equations(1).matrix.transpose()).inverse();
  int solves = 0;
  const auto divide = [&](const Eigen::VectorXd& b) -> Eigen::VectorXd {
    ++solves;
    return near * b;
  };
  const Eigen::VectorXd found =
      conjugate_residuals([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return all.matrix * x; }, divide, all.rhs, 1e-8);
  EXPECT_EQ(solves, 2);
  EXPECT_LT((found - all.solution).norm(), 1e-8 * all.solution.norm());
}

TEST(ConjugateResiduals, OfNothingAreNothingAndOfWhatIsNotFiniteAreNotEither) {
  const auto same = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x; };
  EXPECT_EQ(conjugate_residuals(same, same, Eigen::VectorXd::Zero(3), 1e-6), Eigen::VectorXd::Zero(3));
  const Eigen::VectorXd bad = Eigen::VectorXd::Constant(3, std::nan(""));
  EXPECT_FALSE(conjugate_residuals(same, same, bad, 1e-6).allFinite());
}

// Each number gets little of itself and all of its neighbour: what lacks moves on, and hardly anything is gained before all
// have had their turn.
TEST(ConjugateResiduals, SayWhenTheyGetNowhere) {
  constexpr int size = 200;
  const auto shift = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    Eigen::VectorXd moved(x.size());
    moved << x.tail(x.size() - 1), x[0];
    return moved + 0.05 * x;
  };
  const auto same = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x; };
  EXPECT_THROW(conjugate_residuals(shift, same, Eigen::VectorXd::Unit(size, 0), 1e-6), RunError);
}

}  // namespace
}  // namespace scree::thermal
