#include "thermal/choose_scheme.h"

#include <cmath>

#include <fmt/format.h>

#include "thermal/heat_run.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

// Measured on one core (README, "Which steps"): only their ratios matter.
constexpr double seconds_per_entry = 1.6e-9;   // of K, in a product with two columns
constexpr double seconds_per_flop = 2.5e-10;   // of a supernodal factorisation
constexpr double seconds_per_factor = 1.2e-9;  // an entry of the factor, in a solve
// What an implicit run takes in all, about.
constexpr double factorisations = 12;
constexpr double solves = 500;
// What the symbolic analysis takes, an unknown [s].
constexpr double seconds_per_unknown = 1e-5;

// The least that implicit steps will cost: analysis, and solves with half the factor of a plane grid (31/4 n log2 n entries
// with nested dissection; George, SIAM J. Numer. Anal. 10, 1973). Solids have more.
double least_implicit(const HeatModel& model) {
  const auto unknowns = static_cast<double>(model.capacity.size());
  return seconds_per_unknown * unknowns + solves * seconds_per_factor * 4 * unknowns * std::log2(unknowns);
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
    return {make_implicit_scheme(model), "conditions or properties change, which stabilised explicit steps do not do"};
  }
  const double stable = stable_step(model).step;
  const double products = stabilised_products(stable, options);
  const double stabilised = products * seconds_per_entry * static_cast<double>(model.conductance.nonZeros());
  if (stabilised < least_implicit(model)) {
    return {make_stabilised_scheme(model, stable),
            fmt::format("some {:.0f} products with K, less than a factorisation takes", products)};
  }
  auto implicit = make_linear_scheme(model);
  const FactorSize factor = implicit->factor_size();
  const double direct = factorisations * seconds_per_flop * factor.flops + solves * seconds_per_factor * factor.entries;
  const std::string figures = fmt::format("{:.0f} products with K or {:.3g} flops a factorisation: about {:.2g} s or {:.2g} s",
                                          products, factor.flops, stabilised, direct);
  if (stabilised < direct) return {make_stabilised_scheme(model, stable), figures};
  return {std::move(implicit), figures};
}

}  // namespace

ChosenScheme choose_scheme(const HeatModel& model, const TimeOptions& options) {
  if (model.shared_capacity) return fourth_order(model, options.integrator);
  switch (options.integrator) {
    case Integrator::implicit:
      return {make_implicit_scheme(model), "asked for"};
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
