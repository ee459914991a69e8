#include "thermal/time_options.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "thermal/problems.h"
#include "thermal/stable_step.h"

namespace scree::thermal {

TimeOptions checked(const TimeOptions& options) {
  const auto refuse = [](const std::string& key, double value, const std::string& rule) {
    throw InputError(problem("heat." + key, fmt::format("{:g}", value), rule));
  };
  if (!(options.tolerance > 0)) refuse("tolerance", options.tolerance, "must be positive, K");
  if (!(options.output_every >= 0)) refuse("output_every", options.output_every, "must not be negative, s");
  if (options.step && !(*options.step > 0)) refuse("step", *options.step, "must be positive, s");
  return options;
}

double explicit_step(const HeatModel& model, const TimeOptions& options) {
  constexpr double most_steps = 1e9;  // of a run: more are none that anyone waits for
  const StableStep stable = stable_step(model);
  const double step = options.step.value_or(stable.step);
  if (step > stable.step) {
    throw InputError(problem("heat.step", fmt::format("{:g} s", step),
                             fmt::format("must be at most the stable step of {:.6g} s, which block {} sets", stable.step,
                                         model.blocks[stable.node].value()),
                             "Leave the step out, or use the implicit integrator, which has no such limit"));
  }
  if (options.until > most_steps * step) {
    throw InputError(
        problem("heat.until", fmt::format("{:g} s", options.until),
                fmt::format("must be at most {:g} explicit steps of {:.6g} s, {}", most_steps, step,
                            options.step ? "heat.step" : fmt::format("which block {} sets", model.blocks[stable.node].value())),
                "Use the implicit integrator, whose steps may be longer"));
  }
  return step;
}

double next_output(const TimeOptions& options, double time) {
  if (options.output_every <= 0) return options.until;
  const double next = (std::floor(time / options.output_every + on_grid) + 1) * options.output_every;
  return next > options.until - on_grid * options.output_every ? options.until : next;
}

}  // namespace scree::thermal
