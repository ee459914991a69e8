#include "thermal/choose_scheme.h"

#include <fmt/format.h>

#include "thermal/problems.h"
#include "thermal/quick_ordering.h"
#include "thermal/stable_step.h"
#include "thermal/step_forecast.h"

namespace scree::thermal {

namespace {

// Measured on two cores (README, "Which steps"): only their ratios matter.
constexpr double seconds_per_entry = 7e-10;  // of K, in a product with two columns

SolverUse use_of(const StepForecast& forecast, const HeatModel& model) {
  return has_constant_properties(model) ? use_of_linear_steps(forecast) : use_of_newton_steps(forecast);
}

// Of K, and of U where a conductivity depends on temperature.
std::int64_t entries_of(const HeatModel& model) {
  return model.conductance.nonZeros() + (model.varying ? model.varying->unit_conductance.nonZeros() : 0);
}

// The pattern of what implicit steps factorise.
SparseMatrix pattern_of(const HeatModel& model) {
  if (!model.varying || model.varying->unit_conductance.nonZeros() == 0) return FreeNodes(model).lower_block(model.conductance);
  return FreeNodes(model).lower_block(SparseMatrix(model.conductance + model.varying->unit_conductance));
}

// Whether implicit steps will cost more than so many seconds, as far as can be told without the analysis of their
// factorisation, which takes a fifth of what the explicit steps of a pile take.
bool implicit_costs_more(double seconds, const HeatModel& model, LinearSolver solver, const SolverUse& use) {
  const double multigrid = multigrid_seconds(entries_of(model), use);
  if (solver == LinearSolver::multigrid) return multigrid > seconds;
  if (solver == LinearSolver::automatic && multigrid <= seconds) return false;
  const auto unknowns = static_cast<double>(model.capacity.size()) - static_cast<double>(model.fixed_nodes.size());
  if (least_cholesky_seconds(unknowns, use) > seconds) return true;
  const FactorSize quick = quick_factor_size(pattern_of(model));
  return quick.possible && least_cholesky_seconds(unknowns, quick, use) > seconds;
}

ChosenScheme implicit(const HeatModel& model, const TimeOptions& options, const std::string& why) {
  const StepForecast forecast = forecast_steps(stable_step(model).step, options);
  auto scheme = make_implicit_scheme(model, options.solver, use_of(forecast, model));
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
    return implicit(model, options, "conditions change in time, which stabilised explicit steps do not do");
  }
  StableSteps stable(model);
  const StepForecast forecast = forecast_steps(stable.at_start().step, options);
  const SolverUse use = use_of(forecast, model);
  const double stabilised = forecast.products * seconds_per_entry * static_cast<double>(entries_of(model));
  if (implicit_costs_more(stabilised, model, options.solver, use)) {
    return {make_stabilised_scheme(model, std::move(stable)),
            fmt::format("some {:.0f} products with K, less than implicit steps take", forecast.products)};
  }
  auto scheme = make_implicit_scheme(model, options.solver, use);
  const SolverCost cost = scheme->solver_cost();
  const std::string figures = fmt::format("{:.0f} products with K, about {:.2g} s, or implicit steps, about {:.2g} s; {}",
                                          forecast.products, stabilised, cost.seconds, cost.why);
  if (stabilised < cost.seconds) return {make_stabilised_scheme(model, std::move(stable)), figures};
  return {std::move(scheme), figures};
}

}  // namespace

ChosenScheme choose_scheme(const HeatModel& model, const TimeOptions& options) {
  if (model.shared_capacity) return fourth_order(model, options.integrator);
  switch (options.integrator) {
    case Integrator::implicit:
      return implicit(model, options, "asked for");
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
