#include "thermal/choose_scheme.h"

#include <algorithm>

#include <fmt/format.h>

#include "thermal/heat_run.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

// Measured on one core (README, "Which steps"): only their ratios matter.
constexpr double seconds_per_entry = 1e-9;  // of K, in a product with two columns

// The least that implicit steps will cost.
double least_implicit(const HeatModel& model, LinearSolver solver) {
  const double multigrid = multigrid_seconds(model.conductance.nonZeros(), use_of_linear_steps);
  const double cholesky = least_cholesky_seconds(static_cast<double>(model.capacity.size()), use_of_linear_steps);
  if (solver == LinearSolver::automatic) return std::min(multigrid, cholesky);
  return solver == LinearSolver::multigrid ? multigrid : cholesky;
}

ChosenScheme implicit(const HeatModel& model, LinearSolver solver, const std::string& why) {
  auto scheme = make_implicit_scheme(model, solver);
  const std::string of_solver = scheme->solver_cost().why;
  return {std::move(scheme), of_solver.empty() ? why : fmt::format("{}; solver: {}", why, of_solver)};
}

ChosenScheme fourth_order(const HeatModel& model, Integrator asked) {
  const bool possible = asked == Integrator::automatic || asked == Integrator::stabilised_explicit;
  if (!possible || !can_be_stabilised(model)) {
    throw InputError(problem("heat.space_order", "4",
                             "must be done in stabilised explicit steps, which do no radiation, nor coefficients or conditions "
                             "that change in time",
                             "Set space_order: 2"));
  }
  return {make_stabilised_scheme(model), "heat.space_order: 4 needs explicit steps"};
}

ChosenScheme chosen_by_cost(const HeatModel& model, const TimeOptions& options) {
  if (!can_be_stabilised(model)) {
    return implicit(model, options.solver, "conditions or properties change, which stabilised explicit steps do not do");
  }
  const double stable = stable_step(model).step;
  const double products = stabilised_products(stable, options);
  const double stabilised = products * seconds_per_entry * static_cast<double>(model.conductance.nonZeros());
  if (stabilised < least_implicit(model, options.solver)) {
    return {make_stabilised_scheme(model, stable),
            fmt::format("some {:.0f} products with K, less than implicit steps take", products)};
  }
  auto scheme = make_linear_scheme(model, options.solver);
  const SolverCost cost = scheme->solver_cost();
  const std::string figures = fmt::format("{:.0f} products with K, about {:.2g} s, or implicit steps, about {:.2g} s; {}",
                                          products, stabilised, cost.seconds, cost.why);
  if (stabilised < cost.seconds) return {make_stabilised_scheme(model, stable), figures};
  return {std::move(scheme), figures};
}

}  // namespace

ChosenScheme choose_scheme(const HeatModel& model, const TimeOptions& options) {
  if (model.shared_capacity) return fourth_order(model, options.integrator);
  switch (options.integrator) {
    case Integrator::implicit:
      return implicit(model, options.solver, "asked for");
    case Integrator::stabilised_explicit:
      return {make_stabilised_scheme(model), "asked for"};
    case Integrator::explicit_euler:
      return {make_explicit_scheme(model), "asked for"};
    case Integrator::automatic:
      break;
  }
  return chosen_by_cost(model, options);
}

}  // namespace scree::thermal
