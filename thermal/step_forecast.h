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

// Over how long steps are taken, and the longest of them [s].
struct StepTimes {
  double until = 0;
  double longest = 0;
};

// Steps pass output times: the longest is a power of two of their intervals, and the whole run if that is smooth. What changes
// in time makes them shorter; they are taken to be a 64th of the run then, or one interval.
StepTimes step_times(const TimeOptions& options, bool changes_in_time);

// `stable`: stable_step() of the model [s], infinite if nothing conducts.
StepForecast forecast_steps(double stable, const StepTimes& times);

// What implicit steps ask of their solver, where the properties are constant and where they are not.
SolverUse use_of_linear_steps(const StepForecast& forecast);
SolverUse use_of_newton_steps(const StepForecast& forecast);
SolverUse use_of_unsymmetric_steps(const StepForecast& forecast);  // where a conductivity depends on temperature
using UseOfSteps = SolverUse (*)(const StepForecast&);             // one of them

// Short steps stabilised, longer ones implicit: the longest short step of those that cost least.
struct StepMix {
  double longest_short = 0;  // [s]; 0 if all steps are implicit
  double products = 0;       // of the short steps
  double seconds = 0;        // that all of them cost
};

struct StepCosts {
  double product = 0;  // with K [s]
  UseOfSteps use_of = use_of_linear_steps;
  // Whether steps of any length may be all that a run takes, as where conditions change in time. A step that costs more in
  // products than in solves is then left to the implicit ones, however few the forecast knows of.
  bool lengths_may_last = false;
};

// `solver`: what solves for the implicit ones.
StepMix cheapest_mix(double stable, const StepTimes& times, const StepCosts& costs, const SolverCost& solver);

// The part of a run's work that is done by a time, so that what is left can be told from it: after a sudden start most of the
// steps are far shorter than those at the end, and the part of the time would say for long that nearly all is left to do.
// Steps grow as for a forecast, from the first one that is seen.
class WorkDone {
 public:
  // What a step costs is taken to grow as this power of its length: 0 for implicit ones, 1/2 for stabilised, 1 for Euler's.
  WorkDone(const StepTimes& times, double cost_exponent);

  // After each step, at these times [s].
  [[nodiscard]] double part(double time);

 private:
  [[nodiscard]] double work(double time) const;

  StepTimes times_;
  double exponent_;
  double first_ = 0;
};

}  // namespace scree::thermal
