#include "thermal/heat_solver.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "thermal/conjugate_residuals.h"
#include "thermal/little_change.h"

namespace scree::thermal {

namespace {

// Of a symmetric matrix: residual over right side, in the energy norm. Increments of a step are at most some hundred kelvin:
// full accuracy is far below any error of a step. The estimate of an error is a difference of like amounts, which takes up to
// three of the six digits.
constexpr double full_accuracy = 1e-10;
constexpr double some_digits = 1e-6;
// Of an unsymmetric one: what the solution lacks, of its norm. The estimate gained digits by the last correction, which is not
// counted: `time_error` of the pile changed in the ninth with 1e-4, in the fourth with 1e-3.
constexpr double four_digits = 1e-4;
constexpr double three_digits = 1e-3;
// Of a conductivity or an entry of the diagonal, before the matrix near an unsymmetric one no longer serves: each iteration
// then gains one digit at least, and takes a tenth to a hundredth of what a new factor takes.
constexpr double served_change = 0.1;
// Of scale K_ii over the rest of the diagonal. Up to it a factor that was rounded to single precision (6e-8) gives two digits
// at the worst; as nearly all numbers off the diagonal have one sign, and do not cancel, it gives six (README,
// "Which steps and which solver").
constexpr double stiffness_of_single_precision = 1e5;

std::optional<KirchhoffMatrix> kirchhoff_of(const HeatModel& model) {
  if (is_symmetric(model)) return std::nullopt;
  return std::make_optional<KirchhoffMatrix>(model);
}

}  // namespace

HeatSolver::HeatSolver(const HeatModel& model, const FreeNodes& free, LinearSolver asked, const CostOfRun& run)
    : free_(free), kirchhoff_(kirchhoff_of(model)), symmetric_(kirchhoff_ ? kirchhoff_->near() : model.conductance) {
  choose(asked, run);
}

void HeatSolver::choose(LinearSolver asked, const CostOfRun& run) {
  const std::int64_t entries = symmetric_.nonZeros();
  if (asked == LinearSolver::multigrid) {
    take_multigrid();
    chosen_ = {asked, multigrid_cost(entries), "asked for"};
    return;
  }
  conductance_ = free_.lower_block(symmetric_);
  factor_ = make_cholesky();
  if (free_.size() == 0) return;
  const FactorSize size = factor_->analyse(conductance_);
  if (asked == LinearSolver::cholesky) {
    chosen_ = {asked, cholesky_cost(size), "asked for"};
    return;
  }
  chosen_ = cheaper_solver(size, entries, run);
  if (chosen_.solver == LinearSolver::multigrid) take_multigrid();
}

void HeatSolver::take_multigrid() {
  factor_.reset();
  conductance_ = {};
  multigrid_ = std::make_unique<Multigrid>(symmetric_, free_);
}

void HeatSolver::prepare(const Linearised& at, double scale) {
  make_ready(at, {free_.gather(at.capacity + scale * at.loss), scale});
}

void HeatSolver::prepare_steady(const Linearised& at) {
  Purpose wanted{free_.gather(at.loss), 1};
  const bool still_near = near_for_ && little_changed(at.conductivity, near_for_->conductivity, served_change) &&
                          little_changed(at.loss, near_for_->loss, served_change);
  if (still_near) {
    kirchhoff_->conduct_by(at.conductivity);
    ready_for_ = std::move(wanted);
    return;
  }
  make_ready(at, std::move(wanted));
  if (kirchhoff_) near_for_ = at;
}

bool HeatSolver::is_ready_for(const Purpose& purpose) const {
  const bool stays = !kirchhoff_ && ready_for_.diagonal.size() > 0;
  return stays && ready_for_.scale == purpose.scale && ready_for_.diagonal == purpose.diagonal;
}

void HeatSolver::make_ready(const Linearised& at, Purpose wanted) {
  if (free_.size() == 0 || is_ready_for(wanted)) return;
  ++factorisations_;
  ready_for_ = {};  // of what is not sound
  near_for_.reset();
  Purpose symmetric = wanted;
  if (kirchhoff_) {
    kirchhoff_->set(at.conductivity);
    if (factor_) conductance_ = free_.lower_block(symmetric_);
    per_variable_ = free_.gather(kirchhoff_->per_variable());
    symmetric.diagonal = wanted.diagonal.cwiseProduct(per_variable_);
  }
  if (multigrid_) {
    multigrid_->prepare(symmetric.diagonal, symmetric.scale);
  } else {
    factorise(symmetric);
  }
  ready_for_ = std::move(wanted);
}

void HeatSolver::factorise(const Purpose& purpose) {
  SparseMatrix matrix = purpose.scale * conductance_;
  matrix.diagonal() += purpose.diagonal;
  factor_->factorise(matrix);
  if (!factor_->sound()) {
    throw RunError(fmt::format(
        "The heat equations of {} nodes could not be factorised for a step scale of {:g} s. Look for blocks of almost no "
        "volume (scree check names the mesh), for joints that conduct a thousand billion times what their blocks do (perfect: "
        "true ties such), or for too little memory; heat.solver: multigrid and the explicit integrator need no factorisation",
        free_.size(), purpose.scale));
  }
  const Eigen::VectorXd conductance = conductance_.diagonal();
  rough_will_do_ = (purpose.scale * conductance.array() <= stiffness_of_single_precision * purpose.diagonal.array()).all();
}

Eigen::MatrixXd HeatSolver::solve(const Eigen::MatrixXd& rhs) const {
  return solve_to(rhs, {full_accuracy, full_accuracy});
}

Eigen::MatrixXd HeatSolver::estimate(const Eigen::MatrixXd& rhs) const {
  return solve_to(rhs, {some_digits, four_digits});
}

Eigen::VectorXd HeatSolver::correction(const Eigen::VectorXd& rhs) const {
  return solve_to(rhs, {some_digits, three_digits});
}

Eigen::MatrixXd HeatSolver::solve_to(const Eigen::MatrixXd& rhs, const Accuracy& accuracy) const {
  if (free_.size() == 0) return rhs;
  SCREE_EXPECT(factorisations_ > 0);
  return checked(kirchhoff_ ? solve_unsymmetric(rhs, accuracy.unsymmetric) : solve_symmetric(rhs, accuracy.symmetric));
}

Eigen::MatrixXd HeatSolver::solve_symmetric(const Eigen::MatrixXd& rhs, double accuracy) const {
  if (multigrid_) return iterate(rhs, accuracy);
  return accuracy >= some_digits && rough_will_do_ ? factor_->estimate(rhs) : factor_->solve(rhs);
}

Eigen::MatrixXd HeatSolver::solve_unsymmetric(const Eigen::MatrixXd& rhs, double accuracy) const {
  const auto multiply = [this](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const Eigen::VectorXd conducted = free_.gather(kirchhoff_->conducted(free_.scatter(x)));
    return ready_for_.diagonal.cwiseProduct(x) + ready_for_.scale * conducted;
  };
  const auto divide = [&](const Eigen::VectorXd& b) -> Eigen::VectorXd {
    return per_variable_.cwiseProduct(solve_symmetric(b, std::min(accuracy, some_digits)).col(0));
  };
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) {
    solution.col(c) = conjugate_residuals(multiply, divide, rhs.col(c), accuracy);
  }
  return solution;
}

Eigen::MatrixXd HeatSolver::iterate(const Eigen::MatrixXd& rhs, double accuracy) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  for (Eigen::Index c = 0; c < rhs.cols(); ++c) solution.col(c) = multigrid_->solve(rhs.col(c), accuracy);
  return solution;
}

Eigen::MatrixXd HeatSolver::checked(Eigen::MatrixXd solution) const {
  if ((factor_ && !factor_->sound()) || !solution.allFinite()) {
    throw RunError("The linear solver gave no finite temperatures. Check conductivities, capacities and loads for huge values");
  }
  return solution;
}

std::string HeatSolver::name() const {
  const std::string symmetric = multigrid_ ? "conjugate gradients with algebraic multigrid (hypre BoomerAMG)"
                                           : "supernodal Cholesky in the order of CHOLMOD";
  return kirchhoff_ ? "conjugate residuals by " + symmetric : symmetric;
}

}  // namespace scree::thermal
