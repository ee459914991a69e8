#include "thermal/heat_solver.h"

#include <utility>

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
// at the worst; as nearly all numbers off the diagonal have one sign, and do not cancel, it gives six (README,
// "Which steps and which solver").
constexpr double stiffness_of_single_precision = 1e5;

}  // namespace

bool is_symmetric(const HeatModel& model) {
  return !model.varying || model.varying->unit_conductance.nonZeros() == 0;
}

HeatSolver::HeatSolver(const HeatModel& model, const FreeNodes& free, LinearSolver asked, const CostOfRun& run) : free_(free) {
  if (is_symmetric(model)) {
    choose(model, asked, run);
    return;
  }
  if (asked == LinearSolver::multigrid) {
    throw InputError(problem("heat.solver", "multigrid", "must not be asked for where a conductivity depends on temperature",
                             "The matrix is not symmetric then: take cholesky, which is LU there"));
  }
  conductance_ = free.block(model.conductance);
  unit_conductance_ = free.block(model.varying->unit_conductance);
  factor_ = make_lu();
  chosen_.why = "a conductivity depends on temperature, which makes the matrix unsymmetric";
}

void HeatSolver::choose(const HeatModel& model, LinearSolver asked, const CostOfRun& run) {
  const std::int64_t entries = model.conductance.nonZeros();
  if (asked == LinearSolver::multigrid) {
    take_multigrid(model);
    chosen_ = {asked, multigrid_cost(entries), "asked for"};
    return;
  }
  conductance_ = free_.lower_block(model.conductance);
  factor_ = make_cholesky();
  if (free_.size() == 0) return;
  const FactorSize size = factor_->analyse(conductance_);
  if (asked == LinearSolver::cholesky) {
    chosen_ = {asked, cholesky_cost(size), "asked for"};
    return;
  }
  chosen_ = cheaper_solver(size, entries, run);
  if (chosen_.solver == LinearSolver::multigrid) take_multigrid(model);
}

void HeatSolver::take_multigrid(const HeatModel& model) {
  factor_.reset();
  conductance_ = {};
  multigrid_ = std::make_unique<Multigrid>(model.conductance, free_);
}

void HeatSolver::prepare(const Linearised& at, double scale) {
  make_ready(at, {free_.gather(at.capacity + scale * at.loss), scale});
}

void HeatSolver::prepare_steady(const Linearised& at) {
  make_ready(at, {free_.gather(at.loss), 1});
}

SparseMatrix HeatSolver::matrix_of(const Purpose& purpose, const Linearised& at) const {
  SparseMatrix matrix = purpose.scale * conductance_;
  if (unit_conductance_.nonZeros() > 0) {
    const Eigen::VectorXd conductivity = purpose.scale * free_.gather(at.conductivity);
    matrix += unit_conductance_ * conductivity.asDiagonal();
  }
  matrix.diagonal() += purpose.diagonal;
  return matrix;
}

bool HeatSolver::is_ready_for(const Purpose& purpose) const {
  const bool made = ready_for_.diagonal.size() > 0 && unit_conductance_.nonZeros() == 0;
  return made && ready_for_.scale == purpose.scale && ready_for_.diagonal == purpose.diagonal;
}

void HeatSolver::make_ready(const Linearised& at, Purpose wanted) {
  if (free_.size() == 0 || is_ready_for(wanted)) return;
  ++factorisations_;
  if (multigrid_) {
    multigrid_->prepare(wanted.diagonal, wanted.scale);
  } else {
    factorise(at, wanted);
  }
  ready_for_ = std::move(wanted);
}

void HeatSolver::factorise(const Linearised& at, const Purpose& purpose) {
  ready_for_ = {};  // of what is not sound
  factor_->factorise(matrix_of(purpose, at));
  if (!factor_->sound()) {
    throw RunError(fmt::format(
        "The heat equations of {} nodes could not be factorised for a step scale of {:g} s. Look for blocks of almost no "
        "volume "
        "(scree check names the mesh), or for too little memory; heat.solver: multigrid and the explicit integrator need no "
        "factorisation",
        free_.size(), purpose.scale));
  }
  const Eigen::VectorXd conductance = conductance_.diagonal();
  rough_will_do_ = (purpose.scale * conductance.array() <= stiffness_of_single_precision * purpose.diagonal.array()).all();
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
  return unit_conductance_.nonZeros() > 0 ? "UMFPACK LU" : "supernodal Cholesky in the order of CHOLMOD";
}

}  // namespace scree::thermal
