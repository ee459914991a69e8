#include "thermal/heat_solver.h"

#include <dlfcn.h>

#include <fmt/format.h>
#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

#include "engine/base/check.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

// A threaded BLAS may round differently with another number of threads, and a resumed run must repeat the same bits. Only
// OpenBLAS has threads among Debian's free ones, and whether it is there is known when the program starts, not when it is
// built.
void use_one_blas_thread() {
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
}

// Residual over right side, in the energy norm. Increments of a step are at most some hundred kelvin: full accuracy is far
// below any error of a step. The estimate of an error is a difference of like amounts, which takes up to three of the six
// digits.
constexpr double full_accuracy = 1e-10;
constexpr double some_digits = 1e-6;

}  // namespace

struct HeatSolver::Factor {
  virtual ~Factor() = default;
  virtual FactorSize analyse(const SparseMatrix& matrix) = 0;
  virtual void factorise(const SparseMatrix& matrix) = 0;
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) = 0;
  [[nodiscard]] virtual bool sound() const = 0;
  bool analysed = false;

  struct Cholesky;
  struct Lu;
};

struct HeatSolver::Factor::Cholesky : Factor {
  Cholesky() { cholesky.cholmod().print = 0; }  // failures are ours to report
  void factorise(const SparseMatrix& matrix) override {
    if (!analysed) analyse(matrix);
    cholesky.factorize(matrix);
  }
  FactorSize analyse(const SparseMatrix& matrix) override {
    cholesky.analyzePattern(matrix);
    analysed = true;
    return {cholesky.cholmod().lnz, cholesky.cholmod().fl, cholesky.cholmod().status == CHOLMOD_OK};
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return cholesky.solve(rhs); }
  [[nodiscard]] bool sound() const override { return cholesky.info() == Eigen::Success; }
  Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> cholesky;
};

struct HeatSolver::Factor::Lu : Factor {
  void factorise(const SparseMatrix& matrix) override {
    kept = matrix;  // the library reads it again when it solves
    if (!analysed) analyse(kept);
    lu.factorize(kept);
  }
  FactorSize analyse(const SparseMatrix& matrix) override {
    lu.analyzePattern(matrix);
    analysed = true;
    return {};  // known only after the factorisation
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return lu.solve(rhs); }
  [[nodiscard]] bool sound() const override { return lu.info() == Eigen::Success; }
  SparseMatrix kept;
  Eigen::UmfPackLU<SparseMatrix> lu;
};

HeatSolver::HeatSolver(const HeatModel& model, const FreeNodes& free, LinearSolver asked, const SolverUse& use) : free_(free) {
  use_one_blas_thread();
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
  factor_ = std::make_unique<Factor::Lu>();
  cost_.why = "a conductivity depends on temperature, which makes the matrix unsymmetric";
}

HeatSolver::~HeatSolver() = default;

void HeatSolver::choose(const HeatModel& model, LinearSolver asked, const SolverUse& use) {
  const std::int64_t entries = model.conductance.nonZeros();
  if (asked == LinearSolver::multigrid) {
    take_multigrid(model);
    cost_ = {multigrid_seconds(entries, use), "asked for"};
    return;
  }
  conductance_ = free_.lower_block(model.conductance);
  factor_ = std::make_unique<Factor::Cholesky>();
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
  SCREE_EXPECT(factor_->analysed);
  return checked(factor_->solve(rhs));
}

Eigen::MatrixXd HeatSolver::estimate(const Eigen::MatrixXd& rhs) const {
  return multigrid_ && free_.size() > 0 ? iterate(rhs, some_digits) : solve(rhs);
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
