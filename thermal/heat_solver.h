// Solves (C + s J) x = b for the free nodes, by a factorisation or by multigrid, whichever is asked for or costs less.
//
// J = K + diag(loss) is symmetric: supernodal Cholesky, one symbolic analysis (CHOLMOD) and a numeric factorisation per matrix,
// or conjugate gradients with algebraic multigrid. With a conductivity that depends on temperature, J = K + U diag(k) +
// diag(loss) is not: then either solves for a symmetric matrix near it (kirchhoff_matrix.h), within an iteration.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "thermal/direct_factor.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/kirchhoff_matrix.h"
#include "thermal/multigrid.h"
#include "thermal/solver_cost.h"

namespace scree::thermal {

class HeatSolver {
 public:
  // Refers to both.
  HeatSolver(const HeatModel& model, const FreeNodes& free, LinearSolver asked, const CostOfRun& run);
  HeatSolver(const HeatSolver&) = delete;
  HeatSolver& operator=(const HeatSolver&) = delete;

  // Prepares for C + scale J [J/K]; scale in seconds. Throws RunError if it cannot be done.
  void prepare(const Linearised& at, double scale);

  // For J alone [W/K]. Where it is not symmetric the matrix near it stays that of before while little changes.
  void prepare_steady(const Linearised& at);

  // Each column of `rhs` [J] to its solution [K]. Needs prepare().
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;

  // To some six digits, or four of an unsymmetric matrix: an iteration ends early, a factor is taken in single precision.
  [[nodiscard]] Eigen::MatrixXd estimate(const Eigen::MatrixXd& rhs) const;

  // Or three: of what is corrected again.
  [[nodiscard]] Eigen::VectorXd correction(const Eigen::VectorXd& rhs) const;

  // Whether solutions are as exact as an iteration makes them, instead of as rounding.
  [[nodiscard]] bool iterates() const { return multigrid_ != nullptr; }

  // Or set-ups of the multigrid: how often it was made ready for another matrix, the same for any number of threads.
  [[nodiscard]] std::int64_t factorisations() const { return factorisations_; }
  [[nodiscard]] std::string name() const;
  [[nodiscard]] const ChosenSolver& chosen() const { return chosen_; }

 private:
  // A matrix is diag(diagonal) + scale K, or scale (K + U diag(k)).
  struct Purpose {
    Eigen::VectorXd diagonal;
    double scale = 0;
  };

  struct Accuracy {
    double symmetric;
    double unsymmetric;
  };

  void choose(LinearSolver asked, const CostOfRun& run);
  void take_multigrid();
  [[nodiscard]] bool is_ready_for(const Purpose& purpose) const;
  void make_ready(const Linearised& at, Purpose wanted);
  void factorise(const Purpose& purpose);
  [[nodiscard]] Eigen::MatrixXd solve_to(const Eigen::MatrixXd& rhs, const Accuracy& accuracy) const;
  [[nodiscard]] Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& rhs, double accuracy) const;
  [[nodiscard]] Eigen::MatrixXd solve_unsymmetric(const Eigen::MatrixXd& rhs, double accuracy) const;
  [[nodiscard]] Eigen::MatrixXd iterate(const Eigen::MatrixXd& rhs, double accuracy) const;
  [[nodiscard]] Eigen::MatrixXd checked(Eigen::MatrixXd solution) const;

  const FreeNodes& free_;
  std::optional<KirchhoffMatrix> kirchhoff_;  // where the matrix is not symmetric
  const SparseMatrix& symmetric_;             // K, or what stands for K + U diag(k)
  SparseMatrix conductance_;                  // its lower triangle of the free nodes, for a factor
  Eigen::VectorXd per_variable_;              // KirchhoffMatrix's, of the free nodes
  std::unique_ptr<DirectFactor> factor_;      // this
  std::unique_ptr<Multigrid> multigrid_;      // or that
  Purpose ready_for_;
  std::optional<Linearised> near_for_;  // the steady state that the matrix near an unsymmetric one was made for
  bool rough_will_do_ = false;          // whether single precision is enough for estimates
  ChosenSolver chosen_;
  std::int64_t factorisations_ = 0;
};

}  // namespace scree::thermal
