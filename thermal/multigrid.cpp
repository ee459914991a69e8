#include "thermal/multigrid.h"

#include <vector>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "thermal/hypre_library.h"

namespace scree::thermal {

namespace {
constexpr int most_iterations = 500;

// BoomerAMG's options by the numbers of its manual, measured in README, "Tried: multigrid". Sweeps of Gauss and Seidel, forward
// on the way down and backward on the way up, keep the cycle symmetric, which conjugate gradients need.
constexpr int hmis = 10;
constexpr int extended_i = 6;
constexpr int most_interpolants = 4;
constexpr double strong = 0.25;
constexpr int forward_sweep = 3, backward_sweep = 4, elimination = 9;
constexpr int down = 1, up = 2, coarsest = 3;

void check() {
  const std::string errors = hypre::take_errors();
  if (!errors.empty()) throw RunError("hypre could not solve the heat equations: " + errors + ". Take heat.solver: cholesky");
}

// Multigrid is set up by itself, before the iteration.
HYPRE_Int no_setup(HYPRE_Solver, HYPRE_Matrix, HYPRE_Vector, HYPRE_Vector) {
  return 0;
}

}  // namespace

struct Multigrid::Hypre {
  Hypre(const SparseMatrix& matrix, const FreeNodes& unknowns);
  ~Hypre();
  Hypre(const Hypre&) = delete;
  Hypre& operator=(const Hypre&) = delete;

  void enter(const Eigen::VectorXd& diagonal, double scale);
  void make_preconditioner();
  void make_iteration();
  [[nodiscard]] HYPRE_ParCSRMatrix rows() const;
  [[nodiscard]] static HYPRE_ParVector values(HYPRE_IJVector vector);

  const SparseMatrix& conductance;
  const FreeNodes& free;
  std::vector<HYPRE_Int> numbers;  // of the unknowns
  HYPRE_IJMatrix matrix = nullptr;
  HYPRE_IJVector rhs = nullptr;
  HYPRE_IJVector solution = nullptr;
  HYPRE_Solver preconditioner = nullptr;
  HYPRE_Solver iteration = nullptr;
};

Multigrid::Hypre::Hypre(const SparseMatrix& of_all, const FreeNodes& unknowns)
    : conductance(of_all), free(unknowns), numbers(static_cast<std::size_t>(unknowns.size())) {
  hypre::start();
  const auto last = static_cast<HYPRE_Int>(free.size()) - 1;
  for (HYPRE_Int i = 0; i <= last; ++i) numbers[i] = i;
  SCREE_HYPRE(HYPRE_IJMatrixCreate)(hypre::communicator(), 0, last, 0, last, &matrix);
  SCREE_HYPRE(HYPRE_IJMatrixSetObjectType)(matrix, HYPRE_PARCSR);
  for (HYPRE_IJVector* vector : {&rhs, &solution}) {
    SCREE_HYPRE(HYPRE_IJVectorCreate)(hypre::communicator(), 0, last, vector);
    SCREE_HYPRE(HYPRE_IJVectorSetObjectType)(*vector, HYPRE_PARCSR);
    SCREE_HYPRE(HYPRE_IJVectorInitialize)(*vector);
    SCREE_HYPRE(HYPRE_IJVectorAssemble)(*vector);
  }
  std::vector<HYPRE_Int> sizes(numbers.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = 1;
    const Eigen::Index node = free.node(static_cast<Eigen::Index>(i));
    for (SparseMatrix::InnerIterator entry(conductance, node); entry; ++entry) {
      if (entry.row() != node && free.unknown(entry.row()) >= 0) ++sizes[i];
    }
  }
  const std::vector<HYPRE_Int> none(numbers.size(), 0);
  SCREE_HYPRE(HYPRE_IJMatrixSetDiagOffdSizes)(matrix, sizes.data(), none.data());
  check();
}

Multigrid::Hypre::~Hypre() {
  if (iteration != nullptr) SCREE_HYPRE(HYPRE_ParCSRPCGDestroy)(iteration);
  if (preconditioner != nullptr) SCREE_HYPRE(HYPRE_BoomerAMGDestroy)(preconditioner);
  for (HYPRE_IJVector vector : {rhs, solution}) SCREE_HYPRE(HYPRE_IJVectorDestroy)(vector);
  SCREE_HYPRE(HYPRE_IJMatrixDestroy)(matrix);
}

HYPRE_ParCSRMatrix Multigrid::Hypre::rows() const {
  void* object = nullptr;
  SCREE_HYPRE(HYPRE_IJMatrixGetObject)(matrix, &object);
  return static_cast<HYPRE_ParCSRMatrix>(object);
}

HYPRE_ParVector Multigrid::Hypre::values(HYPRE_IJVector vector) {
  void* object = nullptr;
  SCREE_HYPRE(HYPRE_IJVectorGetObject)(vector, &object);
  return static_cast<HYPRE_ParVector>(object);
}

void Multigrid::Hypre::enter(const Eigen::VectorXd& diagonal, double scale) {
  SCREE_HYPRE(HYPRE_IJMatrixInitialize)(matrix);
  const auto set_values = SCREE_HYPRE(HYPRE_IJMatrixSetValues);
  std::vector<HYPRE_Int> columns;
  std::vector<double> row;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto unknown = static_cast<Eigen::Index>(i);
    const Eigen::Index node = free.node(unknown);
    columns.assign(1, numbers[i]);
    row.assign(1, diagonal[unknown]);
    for (SparseMatrix::InnerIterator entry(conductance, node); entry; ++entry) {
      if (entry.row() == node) {
        row[0] += scale * entry.value();
      } else if (const Eigen::Index column = free.unknown(entry.row()); column >= 0) {
        columns.push_back(static_cast<HYPRE_Int>(column));
        row.push_back(scale * entry.value());
      }
    }
    auto count = static_cast<HYPRE_Int>(columns.size());
    set_values(matrix, 1, &count, &numbers[i], columns.data(), row.data());
  }
  SCREE_HYPRE(HYPRE_IJMatrixAssemble)(matrix);
  check();
}

void Multigrid::Hypre::make_preconditioner() {
  if (preconditioner != nullptr) SCREE_HYPRE(HYPRE_BoomerAMGDestroy)(preconditioner);
  SCREE_HYPRE(HYPRE_BoomerAMGCreate)(&preconditioner);
  SCREE_HYPRE(HYPRE_BoomerAMGSetTol)(preconditioner, 0);
  SCREE_HYPRE(HYPRE_BoomerAMGSetMaxIter)(preconditioner, 1);
  SCREE_HYPRE(HYPRE_BoomerAMGSetPrintLevel)(preconditioner, 0);
  SCREE_HYPRE(HYPRE_BoomerAMGSetCoarsenType)(preconditioner, hmis);
  SCREE_HYPRE(HYPRE_BoomerAMGSetInterpType)(preconditioner, extended_i);
  SCREE_HYPRE(HYPRE_BoomerAMGSetPMaxElmts)(preconditioner, most_interpolants);
  SCREE_HYPRE(HYPRE_BoomerAMGSetStrongThreshold)(preconditioner, strong);
  SCREE_HYPRE(HYPRE_BoomerAMGSetCycleRelaxType)(preconditioner, forward_sweep, down);
  SCREE_HYPRE(HYPRE_BoomerAMGSetCycleRelaxType)(preconditioner, backward_sweep, up);
  SCREE_HYPRE(HYPRE_BoomerAMGSetCycleRelaxType)(preconditioner, elimination, coarsest);
  SCREE_HYPRE(HYPRE_BoomerAMGSetRelaxOrder)(preconditioner, 0);  // in the order of the rows
  SCREE_HYPRE(HYPRE_BoomerAMGSetKeepTranspose)(preconditioner, 1);
  SCREE_HYPRE(HYPRE_BoomerAMGSetup)(preconditioner, rows(), values(rhs), values(solution));
  check();
}

void Multigrid::Hypre::make_iteration() {
  if (iteration == nullptr) {
    SCREE_HYPRE(HYPRE_ParCSRPCGCreate)(hypre::communicator(), &iteration);
    SCREE_HYPRE(HYPRE_PCGSetMaxIter)(iteration, most_iterations);
  }
  const auto apply = reinterpret_cast<HYPRE_PtrToSolverFcn>(hypre::find("HYPRE_BoomerAMGSolve"));
  SCREE_HYPRE(HYPRE_PCGSetPrecond)(iteration, apply, no_setup, preconditioner);
  SCREE_HYPRE(HYPRE_ParCSRPCGSetup)(iteration, rows(), values(rhs), values(solution));
  check();
}

Multigrid::Multigrid(const SparseMatrix& conductance, const FreeNodes& free) : conductance_(conductance), free_(free) {
  static_cast<void>(hypre::find("HYPRE_Init"));
}

Multigrid::~Multigrid() = default;

void Multigrid::prepare(const Eigen::VectorXd& diagonal, double scale) {
  if (!hypre_) hypre_ = std::make_unique<Hypre>(conductance_, free_);
  hypre_->enter(diagonal, scale);
  hypre_->make_preconditioner();
  hypre_->make_iteration();
}

Eigen::VectorXd Multigrid::solve(const Eigen::VectorXd& rhs, double accuracy) {
  const auto size = static_cast<HYPRE_Int>(rhs.size());
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(size);
  SCREE_HYPRE(HYPRE_IJVectorSetValues)(hypre_->rhs, size, hypre_->numbers.data(), rhs.data());
  SCREE_HYPRE(HYPRE_IJVectorSetValues)(hypre_->solution, size, hypre_->numbers.data(), solution.data());
  SCREE_HYPRE(HYPRE_PCGSetTol)(hypre_->iteration, accuracy);
  SCREE_HYPRE(HYPRE_ParCSRPCGSolve)
  (hypre_->iteration, hypre_->rows(), Hypre::values(hypre_->rhs), Hypre::values(hypre_->solution));
  check();
  HYPRE_Int taken = 0;
  SCREE_HYPRE(HYPRE_PCGGetNumIterations)(hypre_->iteration, &taken);
  iterations_ += taken;
  if (taken == most_iterations) {
    throw RunError(
        fmt::format("Conjugate gradients did not reach their accuracy in {} iterations. Take heat.solver: cholesky, or "
                    "look for blocks of almost no volume (scree check names the mesh)",
                    most_iterations));
  }
  SCREE_HYPRE(HYPRE_IJVectorGetValues)(hypre_->solution, size, hypre_->numbers.data(), solution.data());
  return solution;
}

}  // namespace scree::thermal
