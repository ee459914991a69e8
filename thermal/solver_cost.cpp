#include "thermal/solver_cost.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scree::thermal {

namespace {

// Measured on two cores (README, "Which steps"): only their ratios matter.
constexpr double seconds_per_flop = 2.5e-11;   // of a supernodal factorisation
constexpr double seconds_per_factor = 1.2e-9;  // an entry of the factor, in a solve
constexpr double seconds_per_unknown = 1e-5;   // of the symbolic analysis
constexpr double seconds_per_setup = 1.5e-7;   // an entry of the matrix, to make the coarse levels
constexpr double seconds_per_cycle = 1e-8;     // an entry of the matrix, in an iteration
constexpr double cycles_per_solve = 15;

// How much more a quick ordering may leave than a thorough one: most in solid cubes (README, "Which steps").
constexpr double entries_of_quick_ordering = 3;
constexpr double flops_of_quick_ordering = 12;

// What a factor may take: with the matrices and the model beside it, a computer of 16 GiB bears that.
constexpr double most_bytes = 8e9;

double bytes(const FactorSize& factor) {
  return static_cast<double>(sizeof(double)) * factor.entries;
}

}  // namespace

SolverCost cholesky_cost(const FactorSize& factor) {
  return {seconds_per_flop * factor.flops, seconds_per_factor * factor.entries};
}

SolverCost multigrid_cost(std::int64_t entries) {
  const auto all = static_cast<double>(entries);
  return {seconds_per_setup * all, cycles_per_solve * seconds_per_cycle * all};
}

// Solves with an eighth of the factor of a large plane grid (31/4 n log2 n entries with nested dissection; George, SIAM J.
// Numer. Anal. 10, 1973). Solids have far more, small plane meshes hardly less.
SolverCost least_cholesky_cost(double unknowns) {
  return {0, seconds_per_factor * unknowns * std::log2(std::max(unknowns, 1.0))};
}

SolverCost least_cholesky_cost(const FactorSize& quick) {
  return cholesky_cost({quick.entries / entries_of_quick_ordering, quick.flops / flops_of_quick_ordering, quick.possible});
}

double seconds_of_analysis(double unknowns) {
  return seconds_per_unknown * unknowns;
}

ChosenSolver cheaper_solver(const FactorSize& factor, std::int64_t entries, const CostOfRun& run) {
  const SolverCost multigrid = multigrid_cost(entries);
  if (!factor.possible) return {LinearSolver::multigrid, multigrid, "a factor would have too many entries"};
  const SolverCost cholesky = cholesky_cost(factor);
  const double by_multigrid = run(multigrid), by_cholesky = run(cholesky);
  const std::string figures =
      fmt::format("a factorisation of {:.3g} flops and {:.2g} GB: about {:.2g} s; multigrid about {:.2g} s", factor.flops,
                  bytes(factor) / 1e9, by_cholesky, by_multigrid);
  if (bytes(factor) > most_bytes || by_multigrid < by_cholesky) return {LinearSolver::multigrid, multigrid, figures};
  return {LinearSolver::cholesky, cholesky, figures};
}

}  // namespace scree::thermal
