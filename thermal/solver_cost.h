// What solving the heat equations costs, by arithmetic with the model's figures: the same everywhere.
#pragma once

#include <cstdint>
#include <string>

#include "thermal/heat_options.h"

namespace scree::thermal {

// What a run will ask of its solver, about.
struct SolverUse {
  double matrices = 0;
  double solves = 0;
};
inline constexpr SolverUse use_of_linear_steps{12, 500};
inline constexpr SolverUse use_of_newton_steps{150, 1000};
inline constexpr SolverUse use_of_steady_state{1, 2};

struct FactorSize {
  double entries = 0;
  double flops = 0;
  bool possible = true;  // or too large for the library
};

struct SolverCost {
  double seconds = 0;  // of one core
  std::string why;     // it is this solver, in words
};

double cholesky_seconds(const FactorSize& factor, const SolverUse& use);
double multigrid_seconds(std::int64_t entries, const SolverUse& use);  // entries of the matrix

// The least that a factorisation of so many unknowns costs, its analysis included.
double least_cholesky_seconds(double unknowns, const SolverUse& use);

// Which solver costs less: Cholesky or multigrid. Its reason compares them.
struct ChosenSolver {
  LinearSolver solver = LinearSolver::cholesky;
  SolverCost cost;
};
ChosenSolver cheaper_solver(const FactorSize& factor, std::int64_t entries, const SolverUse& use);

}  // namespace scree::thermal
