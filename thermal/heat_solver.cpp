#include "thermal/heat_solver.h"

#include <future>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/threads.h"
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
// Of a factor, up to which there may be two: 0.4 GB, half as much again in single precision.
constexpr double most_entries_twice = 5e7;

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
  ready_.factor = make_lu();
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
  ready_.factor = make_cholesky();
  if (free_.size() == 0) return;
  const FactorSize factor = ready_.factor->analyse(conductance_);
  room_beside_ = factor.entries <= most_entries_twice;
  if (asked == LinearSolver::cholesky) {
    cost_ = {cholesky_seconds(factor, use), "asked for"};
    return;
  }
  ChosenSolver chosen = cheaper_solver(factor, entries, use);
  if (chosen.solver == LinearSolver::multigrid) take_multigrid(model);
  cost_ = std::move(chosen.cost);
}

void HeatSolver::take_multigrid(const HeatModel& model) {
  ready_.factor.reset();
  room_beside_ = false;
  conductance_ = {};
  multigrid_ = std::make_unique<Multigrid>(model.conductance, free_);
}

void HeatSolver::prepare(const Linearised& at, double scale, std::optional<double> expected) {
  make_ready(at, purpose(at, scale), expected ? std::optional(purpose(at, *expected)) : std::nullopt);
}

void HeatSolver::prepare_steady(const Linearised& at) {
  make_ready(at, {free_.gather(at.loss), 1}, {});
}

HeatSolver::Purpose HeatSolver::purpose(const Linearised& at, double scale) const {
  return {free_.gather(at.capacity + scale * at.loss), scale};
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

bool HeatSolver::fits(const Ready& ready, const Purpose& purpose) const {
  const bool made = ready.purpose.diagonal.size() > 0 && unit_conductance_.nonZeros() == 0;
  return made && ready.purpose.scale == purpose.scale && ready.purpose.diagonal == purpose.diagonal;
}

void HeatSolver::make_ready(const Linearised& at, Purpose wanted, std::optional<Purpose> expected) {
  if (free_.size() == 0 || fits(ready_, wanted)) return;
  const bool first = factorisations_++ == 0;
  if (multigrid_) {
    multigrid_->prepare(wanted.diagonal, wanted.scale);
    ready_.purpose = std::move(wanted);
    return;
  }
  if (first && expected && room_beside_ && threads_in_use() > 1) beside_.factor = ready_.factor->another();
  if (beside_.factor) std::swap(ready_, beside_);
  if (fits(ready_, wanted)) return;
  std::future<void> next;
  if (beside_.factor && expected && !fits(beside_, *expected)) {
    next = std::async(std::launch::async, [&] { factorise(beside_, at, std::move(*expected)); });
  }
  const double scale = wanted.scale;
  factorise(ready_, at, std::move(wanted));
  if (next.valid()) next.get();
  if (ready_.factor->sound()) return;
  throw RunError(
      fmt::format("The heat equations of {} nodes could not be factorised for a step scale of {:g} s. Look for blocks of "
                  "almost no volume (scree check names the mesh), or for too little memory; heat.solver: multigrid and the "
                  "explicit integrator need no factorisation",
                  free_.size(), scale));
}

// What is not sound is of no purpose.
void HeatSolver::factorise(Ready& ready, const Linearised& at, Purpose purpose) const {
  ready.purpose = {};
  ready.factor->factorise(matrix_of(purpose, at));
  if (!ready.factor->sound()) return;
  const Eigen::VectorXd conductance = conductance_.diagonal();
  ready.rough_will_do = (purpose.scale * conductance.array() <= stiffness_of_single_precision * purpose.diagonal.array()).all();
  ready.purpose = std::move(purpose);
}

Eigen::MatrixXd HeatSolver::solve(const Eigen::MatrixXd& rhs) const {
  if (free_.size() == 0) return rhs;
  if (multigrid_) return iterate(rhs, full_accuracy);
  SCREE_EXPECT(factorisations_ > 0);
  return checked(ready_.factor->solve(rhs));
}

Eigen::MatrixXd HeatSolver::estimate(const Eigen::MatrixXd& rhs) const {
  if (multigrid_ && free_.size() > 0) return iterate(rhs, some_digits);
  return ready_.rough_will_do ? checked(ready_.factor->estimate(rhs)) : solve(rhs);
}

Eigen::MatrixXd HeatSolver::iterate(const Eigen::MatrixXd& rhs, double accuracy) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) solution.col(c) = multigrid_->solve(rhs.col(c), accuracy);
  return checked(std::move(solution));
}

Eigen::MatrixXd HeatSolver::checked(Eigen::MatrixXd solution) const {
  if ((ready_.factor && !ready_.factor->sound()) || !solution.allFinite()) {
    throw RunError("The linear solver gave no finite temperatures. Check conductivities, capacities and loads for huge values");
  }
  return solution;
}

std::string HeatSolver::name() const {
  if (multigrid_) return "conjugate gradients with algebraic multigrid (hypre BoomerAMG)";
  return unit_conductance_.nonZeros() > 0 ? "UMFPACK LU" : "CHOLMOD supernodal Cholesky";
}

}  // namespace scree::thermal
