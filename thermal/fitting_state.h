// Whether a state can be gone on from in a run.
#pragma once

#include <algorithm>

#include "thermal/heat_run.h"

namespace scree::thermal {

// `start`: where that run begins.
inline bool fits(const HeatState& state, const HeatState& start) {
  const auto is_of_rows = [&](const StepEnd& end) { return end.temperature->size() == start.temperature.size(); };
  return std::all_of(state.earlier.begin(), state.earlier.end(), is_of_rows) &&
         state.temperature.size() == start.temperature.size() && state.error.size() == start.error.size() &&
         (state.rate.size() == 0 || state.rate.size() == start.temperature.size()) &&
         state.lumping.carried.size() == start.lumping.carried.size() &&
         (state.matrix.temperature.size() == 0 || state.matrix.temperature.size() == start.temperature.size()) &&
         state.ledger.by_boundary.size() == start.ledger.by_boundary.size() &&
         state.ledger.by_applied.size() == start.ledger.by_applied.size() &&
         state.ledger.by_surroundings.size() == start.ledger.by_surroundings.size();
}

}  // namespace scree::thermal
