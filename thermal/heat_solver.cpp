#include "thermal/heat_solver.h"

#include <dlfcn.h>

#include <fmt/format.h>
#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

#include "engine/base/check.h"

namespace scree::thermal {

namespace {

// A threaded BLAS may round differently with another number of threads, and a resumed run must repeat the same bits. Only
// OpenBLAS has threads among Debian's free ones, and whether it is there is known when the program starts, not when it is
// built.
void use_one_blas_thread() {
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
}

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
    return {cholesky.cholmod().lnz, cholesky.cholmod().fl};
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

HeatSolver::HeatSolver(const HeatModel& model, const FreeNodes& free) : free_(free) {
  use_one_blas_thread();
  const bool symmetric = !model.varying || model.varying->unit_conductance.nonZeros() == 0;
  if (symmetric) {
    conductance_ = free.lower_block(model.conductance);
    factor_ = std::make_unique<Factor::Cholesky>();
  } else {
    conductance_ = free.block(model.conductance);
    unit_conductance_ = free.block(model.varying->unit_conductance);
    factor_ = std::make_unique<Factor::Lu>();
  }
}

HeatSolver::~HeatSolver() = default;

void HeatSolver::prepare(const Linearised& at, double scale) {
  factorise(free_.gather(at.capacity + scale * at.loss), at, scale);
}

void HeatSolver::prepare_steady(const Linearised& at) {
  factorise(free_.gather(at.loss), at, 1);
}

FactorSize HeatSolver::analyse(const Linearised& at) {
  if (free_.size() == 0) return {};
  return factor_->analyse(matrix_of(free_.gather(at.capacity), at, 1));
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

void HeatSolver::factorise(const Eigen::VectorXd& diagonal, const Linearised& at, double scale) {
  if (free_.size() == 0) return;
  factor_->factorise(matrix_of(diagonal, at, scale));
  ++factorisations_;
  if (factor_->sound()) return;
  throw RunError(
      fmt::format("The heat equations of {} nodes could not be factorised for a step scale of {:g} s. Look for blocks of "
                  "almost no volume (scree check names the mesh), or for too little memory; the explicit integrator needs no "
                  "factorisation",
                  free_.size(), scale));
}

Eigen::MatrixXd HeatSolver::solve(const Eigen::MatrixXd& rhs) const {
  if (free_.size() == 0) return rhs;
  SCREE_EXPECT(factor_->analysed);
  Eigen::MatrixXd solution = factor_->solve(rhs);
  if (!factor_->sound() || !solution.allFinite()) {
    throw RunError("The linear solver gave no finite temperatures. Check conductivities, capacities and loads for huge values");
  }
  return solution;
}

std::string HeatSolver::name() const {
  return unit_conductance_.nonZeros() > 0 ? "UMFPACK LU" : "CHOLMOD supernodal Cholesky";
}

}  // namespace scree::thermal
