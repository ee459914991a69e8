// How many steps a run will take, about, before one is made: what its cost is estimated from.
#pragma once

#include "thermal/heat_options.h"
#include "thermal/solver_cost.h"

namespace scree::thermal {

struct StepForecast {
  double steps = 0;
  double lengths = 0;   // that differ: each is a matrix of its own for implicit steps
  double products = 0;  // with K, of stabilised explicit steps
};

// `stable`: stable_step() of the model [s], infinite if nothing conducts.
StepForecast forecast_steps(double stable, const TimeOptions& options);

// What implicit steps ask of their solver, where the properties are constant and where they are not.
SolverUse use_of_linear_steps(const StepForecast& forecast);
SolverUse use_of_newton_steps(const StepForecast& forecast);

}  // namespace scree::thermal
