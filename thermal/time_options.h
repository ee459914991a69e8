// What of the time options makes no sense, and what they leave open.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// The options; throws InputError for one that makes no sense by itself.
TimeOptions checked(const TimeOptions& options);

// The step of explicit Euler that is asked for, or the largest stable one [s]. Throws InputError for more, with the node that
// limits it, and for a thousand million steps and more.
double explicit_step(const HeatModel& model, const TimeOptions& options);

// Time is on an output time if it is this close to one, in output intervals.
inline constexpr double on_grid = 1e-9;

// The first output time after `time`: a multiple of the output interval, or the end [s].
double next_output(const TimeOptions& options, double time);

}  // namespace scree::thermal
