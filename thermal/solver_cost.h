// What solving the heat equations costs, by arithmetic with the model's figures: the same everywhere.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "thermal/heat_options.h"

namespace scree::thermal {

// Seconds on two cores.
struct SolverCost {
  double matrix = 0;  // to make ready for a matrix
  double solve = 0;   // a right side: to full accuracy or to some digits, or both at once
};

// What a run will ask of its solver, about: by default one of some hundred steps.
struct SolverUse {
  double matrices = 12;
  double solves = 500;

  [[nodiscard]] double operator()(const SolverCost& cost) const { return matrices * cost.matrix + solves * cost.solve; }
};
inline constexpr SolverUse use_of_steady_state{1, 2};
inline constexpr SolverUse use_of_unsymmetric_steady_state{1, 8};

// What a run takes by a solver of such a cost [s]: a SolverUse, or more than that.
using CostOfRun = std::function<double(const SolverCost&)>;

struct FactorSize {
  double entries = 0;  // as they are kept, with the zeros of supernodes
  double flops = 0;
  bool possible = true;  // or too large for the library
};

SolverCost cholesky_cost(const FactorSize& factor);
SolverCost multigrid_cost(std::int64_t entries);  // of the matrix

// The least that factorisations of so many unknowns cost: without a look at the matrix, and by an ordering of it
// (quick_ordering.h). The analysis that tells the true cost takes seconds_of_analysis(), about.
SolverCost least_cholesky_cost(double unknowns);
SolverCost least_cholesky_cost(const FactorSize& quick);
double seconds_of_analysis(double unknowns);

// Which solver costs less: Cholesky or multigrid.
struct ChosenSolver {
  LinearSolver solver = LinearSolver::cholesky;
  SolverCost cost;
  std::string why;  // compares them
};
ChosenSolver cheaper_solver(const FactorSize& factor, std::int64_t entries, const CostOfRun& run);

}  // namespace scree::thermal
