#include "thermal/heat_solver.h"

#include <fmt/format.h>

#include "engine/base/check.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

// Residual over right side, in the energy norm. Increments of a step are at most some hundred kelvin: full accuracy is far
// below any error of a step. The estimate of an error is a difference of like amounts, which takes up to three of the six
// digits.
constexpr double full_accuracy = 1e-10;
constexpr double some_digits = 1e-6;
// Of scale K_ii over the rest of the diagonal. Up to it a factor that was rounded to single precision (6e-8) gives two digits
// at the worst; as nearly all numbers off the diagonal have one sign, and do not cancel, it gives six (README, "Solver").
constexpr double stiffness_of_single_precision = 1e5;

}  // namespace

HeatSolver::HeatSolver(const HeatModel& model, const FreeNodes& free, LinearSolver asked, const SolverUse& use) : free_(free) {
  const bool symmetric = !model.varying || model.varying->unit_conductance.nonZeros() == 0;
  if (symmetric) {
    choose(model, asked, use);
    return;
  }
  if (asked == LinearSolver::multigrid) {
    throw InputError(problem("heat.solver", "multigrid", "must not be asked for where a conductivity depends on temperature",
                             "The matrix is not symmetric then: take cholesky, which is LU there"));
  }
  conductance_ = free.block(model.conductance);
  unit_conductance_ = free.block(model.varying->unit_conductance);
  factor_ = make_lu();
  cost_.why = "a conductivity depends on temperature, which makes the matrix unsymmetric";
}

void HeatSolver::choose(const HeatModel& model, LinearSolver asked, const SolverUse& use) {
  const std::int64_t entries = model.conductance.nonZeros();
  if (asked == LinearSolver::multigrid) {
    take_multigrid(model);
    cost_ = {multigrid_seconds(entries, use), "asked for"};
    return;
  }
  conductance_ = free_.lower_block(model.conductance);
  factor_ = make_cholesky();
  if (free_.size() == 0) return;
  const FactorSize factor = factor_->analyse(conductance_);
  if (asked == LinearSolver::cholesky) {
    cost_ = {cholesky_seconds(factor, use), "asked for"};
    return;
  }
  ChosenSolver chosen = cheaper_solver(factor, entries, use);
  if (chosen.solver == LinearSolver::multigrid) take_multigrid(model);
  cost_ = std::move(chosen.cost);
}

void HeatSolver::take_multigrid(const HeatModel& model) {
  factor_.reset();
  conductance_ = {};
  multigrid_ = std::make_unique<Multigrid>(model.conductance, free_);
}

void HeatSolver::prepare(const Linearised& at, double scale) {
  make_ready(free_.gather(at.capacity + scale * at.loss), at, scale);
}

void HeatSolver::prepare_steady(const Linearised& at) {
  make_ready(free_.gather(at.loss), at, 1);
}

SparseMatrix HeatSolver::matrix_of(const Eigen::VectorXd& diagonal, const Linearised& at, double scale) const {
  SparseMatrix matrix = scale * conductance_;
  if (unit_conductance_.nonZeros() > 0) {
    const Eigen::VectorXd conductivity = scale * free_.gather(at.conductivity);
    matrix += unit_conductance_ * conductivity.asDiagonal();
  }
  matrix.diagonal() += diagonal;
  return matrix;
}

void HeatSolver::make_ready(const Eigen::VectorXd& diagonal, const Linearised& at, double scale) {
  if (free_.size() == 0) return;
  const bool ready = factorisations_ > 0 && scale == scale_ && unit_conductance_.nonZeros() == 0 && diagonal == diagonal_;
  if (ready) return;
  multigrid_ ? multigrid_->prepare(diagonal, scale) : factorise(diagonal, at, scale);
  ++factorisations_;
  diagonal_ = diagonal;
  scale_ = scale;
}

void HeatSolver::factorise(const Eigen::VectorXd& diagonal, const Linearised& at, double scale) {
  factor_->factorise(matrix_of(diagonal, at, scale));
  const Eigen::VectorXd conductance = conductance_.diagonal();
  rough_will_do_ = (scale * conductance.array() <= stiffness_of_single_precision * diagonal.array()).all();
  if (factor_->sound()) return;
  throw RunError(
      fmt::format("The heat equations of {} nodes could not be factorised for a step scale of {:g} s. Look for blocks of "
                  "almost no volume (scree check names the mesh), or for too little memory; heat.solver: multigrid and the "
                  "explicit integrator need no factorisation",
                  free_.size(), scale));
}

Eigen::MatrixXd HeatSolver::solve(const Eigen::MatrixXd& rhs) const {
  if (free_.size() == 0) return rhs;
  if (multigrid_) return iterate(rhs, full_accuracy);
  SCREE_EXPECT(factorisations_ > 0);
  return checked(factor_->solve(rhs));
}

Eigen::MatrixXd HeatSolver::estimate(const Eigen::MatrixXd& rhs) const {
  if (multigrid_ && free_.size() > 0) return iterate(rhs, some_digits);
  return rough_will_do_ ? checked(factor_->estimate(rhs)) : solve(rhs);
}

Eigen::MatrixXd HeatSolver::iterate(const Eigen::MatrixXd& rhs, double accuracy) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) solution.col(c) = multigrid_->solve(rhs.col(c), accuracy);
  return checked(std::move(solution));
}

Eigen::MatrixXd HeatSolver::checked(Eigen::MatrixXd solution) const {
  if ((factor_ && !factor_->sound()) || !solution.allFinite()) {
    throw RunError("The linear solver gave no finite temperatures. Check conductivities, capacities and loads for huge values");
  }
  return solution;
}

std::string HeatSolver::name() const {
  if (multigrid_) return "conjugate gradients with algebraic multigrid (hypre BoomerAMG)";
  return unit_conductance_.nonZeros() > 0 ? "UMFPACK LU" : "CHOLMOD supernodal Cholesky";
}

}  // namespace scree::thermal
