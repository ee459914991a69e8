// What solving the heat equations costs, by arithmetic with the model's figures: the same everywhere.
#pragma once

#include <cstdint>
#include <string>

#include "thermal/heat_options.h"

namespace scree::thermal {

// What a run will ask of its solver, about: by default one of some hundred steps.
struct SolverUse {
  double matrices = 12;
  double solves = 500;
};
inline constexpr SolverUse use_of_steady_state{1, 2};

struct FactorSize {
  double entries = 0;  // as they are kept, with the zeros of supernodes
  double flops = 0;
  bool possible = true;  // or too large for the library
};

struct SolverCost {
  double seconds = 0;  // on two cores
  std::string why;     // it is this solver, in words
};

double cholesky_seconds(const FactorSize& factor, const SolverUse& use);
double multigrid_seconds(std::int64_t entries, const SolverUse& use);  // entries of the matrix

// The least that factorisations of so many unknowns cost, their analysis included: without a look at the matrix, and by an
// ordering of it (quick_ordering.h).
double least_cholesky_seconds(double unknowns, const SolverUse& use);
double least_cholesky_seconds(double unknowns, const FactorSize& quick, const SolverUse& use);

// Which solver costs less: Cholesky or multigrid. Its reason compares them.
struct ChosenSolver {
  LinearSolver solver = LinearSolver::cholesky;
  SolverCost cost;
};
ChosenSolver cheaper_solver(const FactorSize& factor, std::int64_t entries, const SolverUse& use);

}  // namespace scree::thermal
