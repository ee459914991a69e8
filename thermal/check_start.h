// What a run would be refused for before its first step, when its model is known.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Throws InputError for options and conditions that make no sense where the run begins, an explicit step above the stable one,
// and a steady state that nothing determines.
void check_start(const HeatModel& model, const TimeOptions& options);

}  // namespace scree::thermal
