#include "thermal/step_forecast.h"

#include <algorithm>
#include <cmath>

namespace scree::thermal {

namespace {

// After a sudden start a step is this part of the time that has passed, from about the stable step up to the output interval
// (README, "Which steps").
constexpr double growth = 0.15;

// What a matrix of Newton's iteration serves for, of the steps: measured 0.3 where properties change by a tenth.
constexpr double steps_of_matrix = 0.3;

double longest_step(const TimeOptions& options) {
  return options.output_every > 0 ? std::min(options.output_every, options.until) : options.until;
}

}  // namespace

StepForecast forecast_steps(double stable, const TimeOptions& options) {
  const double every = longest_step(options);
  const double later = std::max(0.0, options.until / every - 1);  // steps of an output interval each
  const double span = std::max(1.0, every / stable);
  StepForecast forecast;
  forecast.steps = 1 + std::log(span) / growth + later;
  forecast.lengths = 1 + std::log2(span);  // each is half or twice the one before
  // A stabilised step h takes 2 sqrt(h/stable) products; those that grow make a geometric series.
  const double products_of_longest = 2 * std::sqrt(every / stable);
  forecast.products = products_of_longest * (std::sqrt(growth) / (1 - std::exp(-growth / 2)) + later);
  return forecast;
}

WorkDone::WorkDone(const TimeOptions& options, double cost_exponent)
    : every_(longest_step(options)), until_(options.until), exponent_(cost_exponent) {}

double WorkDone::part(double time) {
  if (first_ == 0) first_ = time;
  return work(time) / work(until_);
}

// A step of growth t costs (growth t)^p, so those up to t add up to the integral of (growth t)^(p - 1) dt.
double WorkDone::work(double time) const {
  const double grown = std::min(time, every_);
  const double later = std::max(0.0, time / every_ - 1);
  if (exponent_ == 0) return 1 + std::log(std::max(1.0, grown / first_)) / growth + later;
  return std::pow(growth, exponent_ - 1) / exponent_ * std::pow(grown / every_, exponent_) + later;
}

SolverUse use_of_linear_steps(const StepForecast& forecast) {
  return {forecast.lengths, 4 * forecast.steps};
}

SolverUse use_of_newton_steps(const StepForecast& forecast) {
  return {std::max(forecast.lengths, steps_of_matrix * forecast.steps), 7 * forecast.steps};
}

}  // namespace scree::thermal
