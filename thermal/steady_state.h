// Temperatures that do not change any more: F(T) = 0, directly.
#pragma once

#include "thermal/heat_run.h"
#include "thermal/solver_cost.h"

namespace scree::thermal {

// Throws InputError if something changes in time, and for blocks from which no path leads to a held temperature or to
// surroundings: nothing says how warm they are, and what is put into them cannot leave.
void check_steady(const HeatModel& model);

// The ledger holds flows [W] instead of heat, none of it stored, and its residual says how well they balance; `steps` counts
// the iterations. One iteration, which is one factorisation, where the properties are constant.
//
// Throws what check_steady() throws, and RunError if the iteration does not converge.
struct SteadyState {
  HeatState state;
  std::string solver;  // in words, for the summary
};
SteadyState find_steady_state(const HeatModel& model, LinearSolver solver);

// By whichever solver costs less.
HeatState steady_state(const HeatModel& model);

}  // namespace scree::thermal
