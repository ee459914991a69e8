#include "thermal/step_forecast.h"

#include <algorithm>
#include <cmath>

namespace scree::thermal {

namespace {

// After a sudden start a step may be this part of the time that has passed, from about the stable step on (README, "Which
// steps").
constexpr double growth = 0.2;

// What a matrix of Newton's iteration serves for, of the steps: measured 0.1 to 0.22 where properties change by a tenth.
constexpr double steps_of_matrix = 0.2;

// What solving for an unsymmetric matrix costs of solves for a symmetric one: four times as many, most of one column in single
// precision.
constexpr double solves_of_unsymmetric = 2;

// Steps of one length, and the time in which they are taken [s].
struct EqualSteps {
  double length;
  double from;
  double to;

  [[nodiscard]] double count_before(double time) const { return std::max(0.0, std::min(time, to) - from) / length; }
};

// Calls visit(EqualSteps) from the last and longest to the first, each length half of the one before it: as long as may be at
// their time, and not below `first`.
template <class Visit>
void for_each_length(double first, const StepTimes& times, const Visit& visit) {
  double to = times.until, length = times.longest;
  for (; length > first; length /= 2) {
    const double from = length / growth;
    if (from >= to) continue;
    visit(EqualSteps{length, from, to});
    to = from;
  }
  visit(EqualSteps{length, 0, to});
}

// Of a stabilised step, about.
double products_of(double length, double stable) {
  return 2 * std::sqrt(length / stable);
}

void add(const EqualSteps& steps, double stable, StepForecast& forecast) {
  const double count = steps.count_before(steps.to);
  forecast.steps += count;
  ++forecast.lengths;
  forecast.products += count * products_of(steps.length, stable);
}

}  // namespace

StepTimes step_times(const TimeOptions& options, bool changes_in_time) {
  const double every = options.output_every;
  if (every <= 0 || every >= options.until) return {options.until, options.until};
  const double part = changes_in_time ? 1.0 / 64 : 1;
  const double intervals = std::exp2(std::floor(std::log2(part * options.until / every)));
  return {options.until, std::max(1.0, intervals) * every};
}

StepForecast forecast_steps(double stable, const StepTimes& times) {
  StepForecast forecast;
  for_each_length(stable, times, [&](const EqualSteps& steps) { add(steps, stable, forecast); });
  return forecast;
}

StepMix cheapest_mix(double stable, const StepTimes& times, const StepCosts& costs, const SolverCost& solver) {
  const StepForecast all = forecast_steps(stable, times);
  StepMix best{0, 0, costs.use_of(all)(solver)};
  const double solves_of_step = costs.use_of({1, 0, 0}).solves * solver.solve;
  StepForecast longer;
  for_each_length(stable, times, [&](const EqualSteps& steps) {
    const bool dear = costs.lengths_may_last && products_of(steps.length, stable) * costs.product > solves_of_step;
    if (longer.steps > 0 && !dear) {
      const double products = all.products - longer.products;
      const double seconds = products * costs.product + costs.use_of(longer)(solver);
      if (seconds < best.seconds) best = {steps.length, products, seconds};
    }
    add(steps, stable, longer);
  });
  return best;
}

WorkDone::WorkDone(const StepTimes& times, double cost_exponent) : times_(times), exponent_(cost_exponent) {}

double WorkDone::part(double time) {
  if (first_ == 0) first_ = time;
  return work(time) / work(times_.until);
}

double WorkDone::work(double time) const {
  double work = 0;
  for_each_length(first_, times_,
                  [&](const EqualSteps& steps) { work += steps.count_before(time) * std::pow(steps.length, exponent_); });
  return work;
}

SolverUse use_of_linear_steps(const StepForecast& forecast) {
  return {forecast.lengths, 4 * forecast.steps};
}

SolverUse use_of_newton_steps(const StepForecast& forecast) {
  return {std::max(forecast.lengths, steps_of_matrix * forecast.steps), 7 * forecast.steps};
}

SolverUse use_of_unsymmetric_steps(const StepForecast& forecast) {
  const SolverUse symmetric = use_of_newton_steps(forecast);
  return {symmetric.matrices, solves_of_unsymmetric * symmetric.solves};
}

}  // namespace scree::thermal
