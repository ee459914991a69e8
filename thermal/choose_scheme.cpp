#include "thermal/choose_scheme.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "thermal/kirchhoff_matrix.h"
#include "thermal/problems.h"
#include "thermal/quick_ordering.h"
#include "thermal/stable_step.h"
#include "thermal/step_forecast.h"

namespace scree::thermal {

namespace {

// Measured on two cores (README, "Which steps"): only their ratios matter.
constexpr double seconds_per_entry = 7e-10;  // of K, in a product with two columns
// What an analysis must promise to save, of what it takes: most of the promise is not kept, as a quick ordering tells the least
// only.
constexpr double least_gain = 3;
constexpr double infinity = std::numeric_limits<double>::infinity();

UseOfSteps use_of_steps(const HeatModel& model) {
  if (has_constant_properties(model)) return use_of_linear_steps;
  return is_symmetric(model) ? use_of_newton_steps : use_of_unsymmetric_steps;
}

// Of K, and of U where a conductivity depends on temperature.
std::int64_t entries_of(const HeatModel& model) {
  return model.conductance.nonZeros() + (model.varying ? model.varying->unit_conductance.nonZeros() : 0);
}

// What the run costs by stabilised steps, and by the cheapest mix of them and of implicit ones.
class RunCosts {
 public:
  RunCosts(const HeatModel& model, const TimeOptions& options, double stable)
      : times_(step_times(options, varies_in_time(model))),
        stable_(stable),
        costs_{seconds_per_entry * static_cast<double>(entries_of(model)), use_of_steps(model), varies_in_time(model)} {}

  [[nodiscard]] double products() const { return forecast_steps(stable_, times_).products; }
  [[nodiscard]] double stabilised() const { return products() * costs_.product; }
  [[nodiscard]] StepMix mixed(const SolverCost& solver) const { return cheapest_mix(stable_, times_, costs_, solver); }

 private:
  StepTimes times_;
  double stable_;
  StepCosts costs_;
};

// What is known of implicit steps before the analysis of their factorisation.
struct Outlook {
  bool may_pay = false;
  double surely_short = 0;  // steps of up to this are explicit, whatever the analysis says [s]; 0 where it is to say
};

// Whether implicit steps, be they only the longer ones, may save so much that it pays to find out, for which the analysis of
// their factorisation is needed: that takes a fifth of what the explicit steps of a pile take. The dearer implicit steps are,
// the longer are those that are left to explicit ones: what the least they can cost leaves to these stays with them.
Outlook outlook(const HeatModel& model, LinearSolver solver, const RunCosts& costs) {
  const double stabilised = costs.stabilised();
  const StepMix multigrid = costs.mixed(multigrid_cost(entries_of(model)));
  if (solver == LinearSolver::multigrid) return {multigrid.seconds <= stabilised};
  const bool by_multigrid = solver == LinearSolver::automatic && multigrid.seconds <= stabilised;
  const auto unknowns = static_cast<double>(model.capacity.size()) - static_cast<double>(model.fixed_nodes.size());
  const double bearable = stabilised - least_gain * seconds_of_analysis(unknowns);
  if (!by_multigrid && costs.mixed(least_cholesky_cost(unknowns)).seconds > bearable) return {};
  const FactorSize quick = quick_factor_size(model, FreeNodes(model));
  if (!quick.possible) return {true};
  const StepMix least = costs.mixed(least_cholesky_cost(quick));
  const bool surely_pay = by_multigrid || costs.mixed(cholesky_cost(quick)).seconds <= stabilised;
  const double longest_short =
      solver == LinearSolver::automatic ? std::min(least.longest_short, multigrid.longest_short) : least.longest_short;
  return {by_multigrid || least.seconds <= bearable, surely_pay ? longest_short : 0};
}

ChosenScheme implicit(const HeatModel& model, const TimeOptions& options, const std::string& why) {
  const StepForecast forecast = forecast_steps(stable_step(model).step, step_times(options, varies_in_time(model)));
  auto scheme = make_implicit_scheme(model, options.solver, use_of_steps(model)(forecast));
  const std::string of_solver = scheme->solver().why;
  const std::string text = of_solver.empty() ? why : fmt::format("{}; solver: {}", why, of_solver);
  return {std::move(scheme), [text] { return text; }};
}

ChosenScheme fourth_order(const HeatModel& model, Integrator asked) {
  const bool stabilised = asked == Integrator::automatic || asked == Integrator::stabilised_explicit;
  if (!stabilised || varies_in_time(model) || !has_constant_properties(model)) {
    throw InputError(problem("heat.space_order", "4",
                             "must be done in stabilised explicit steps, which do no radiation, nor coefficients or conditions "
                             "that change in time",
                             "Set space_order: 2"));
  }
  return {make_stabilised_scheme(model), [] { return "heat.space_order: 4 needs explicit steps"; }};
}

LongSteps long_steps(const HeatModel& model, LinearSolver asked, const RunCosts& costs) {
  auto scheme = make_implicit_scheme(model, asked, [&](const SolverCost& solver) { return costs.mixed(solver).seconds; });
  const ChosenSolver solver = scheme->solver();
  const StepMix mix = costs.mixed(solver.cost);
  const std::string of_mix =
      mix.longest_short > 0 ? fmt::format("{:.0f} of them and implicit steps above {:.3g} s", mix.products, mix.longest_short)
                            : "implicit steps";
  const std::string figures = fmt::format("{:.0f} products with K, about {:.2g} s, or {}, about {:.2g} s; {}", costs.products(),
                                          costs.stabilised(), of_mix, mix.seconds, solver.why);
  return {std::move(scheme), mix.seconds > costs.stabilised() ? infinity : mix.longest_short, figures};
}

ChosenScheme chosen_by_cost(const HeatModel& model, const TimeOptions& options) {
  StableSteps stable(model);
  const RunCosts costs(model, options, stable.at_start().step);
  const Outlook before = outlook(model, options.solver, costs);
  if (!before.may_pay) {
    return {make_stabilised_scheme(model, std::move(stable)), [products = costs.products()] {
              return fmt::format("some {:.0f} products with K, less than implicit steps take", products);
            }};
  }
  if (before.surely_short > 0) {
    const MadeMeanwhile<LongSteps> later([&model, asked = options.solver, costs] { return long_steps(model, asked, costs); });
    return {make_mixed_scheme(make_stabilised_scheme(model, std::move(stable)), later, before.surely_short),
            [later] { return later.get().why; }};
  }
  LongSteps now = long_steps(model, options.solver, costs);
  const auto why = [text = now.why] { return text; };
  if (now.longest_short == infinity) return {make_stabilised_scheme(model, std::move(stable)), why};
  if (now.longest_short == 0) return {std::move(now.scheme), why};
  return {make_mixed_scheme(make_stabilised_scheme(model, std::move(stable)), MadeMeanwhile(std::move(now))), why};
}

}  // namespace

ChosenScheme choose_scheme(const HeatModel& model, const TimeOptions& options) {
  if (model.shared_capacity) return fourth_order(model, options.integrator);
  switch (options.integrator) {
    case Integrator::implicit:
      return implicit(model, options, "asked for");
    case Integrator::stabilised_explicit:
      return {make_stabilised_scheme(model), [] { return "asked for"; }};
    case Integrator::explicit_euler:
      return {make_explicit_scheme(model), [] { return "asked for"; }};
    case Integrator::automatic:
      break;
  }
  return chosen_by_cost(model, options);
}

}  // namespace scree::thermal
