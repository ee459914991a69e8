#include "thermal/shifted_solver.h"

#include <dlfcn.h>

#include <fmt/format.h>
#include <Eigen/CholmodSupport>

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

struct ShiftedSolver::Factor {
  Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> cholesky;
};

ShiftedSolver::ShiftedSolver(Eigen::VectorXd capacity, const SparseMatrix& conductance)
    : capacity_(std::move(capacity)), conductance_(conductance), factor_(std::make_unique<Factor>()) {
  if (capacity_.size() == 0) return;
  use_one_blas_thread();
  factor_->cholesky.cholmod().print = 0;  // failures are ours to report
  factor_->cholesky.analyzePattern(conductance_);
}

ShiftedSolver::~ShiftedSolver() = default;

void ShiftedSolver::prepare(double shift) {
  if (shift == shift_ || capacity_.size() == 0) return;
  SparseMatrix matrix = shift * conductance_;
  matrix.diagonal() += capacity_;
  factor_->cholesky.factorize(matrix);
  ++factorisations_;
  if (factor_->cholesky.info() != Eigen::Success) {
    throw RunError(
        fmt::format("The heat equations of {} nodes could not be factorised for a step scale of {:g} s. Look for blocks of "
                    "almost no volume "
                    "(scree check names the mesh), or for too little memory; the explicit integrator needs no factorisation",
                    capacity_.size(), shift));
  }
  shift_ = shift;
}

Eigen::MatrixXd ShiftedSolver::solve(const Eigen::MatrixXd& rhs) const {
  if (capacity_.size() == 0) return rhs;
  SCREE_EXPECT(shift_ >= 0);
  Eigen::MatrixXd solution = factor_->cholesky.solve(rhs);
  if (factor_->cholesky.info() != Eigen::Success || !solution.allFinite()) {
    throw RunError("The linear solver gave no finite temperatures. Check conductivities, capacities and loads for huge values");
  }
  return solution;
}

}  // namespace scree::thermal
