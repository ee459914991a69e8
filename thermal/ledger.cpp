#include <cmath>
#include <numeric>

#include "thermal/heat_run.h"

namespace scree::thermal {

double Ledger::residual() const {
  double in = start_jump;
  in = std::accumulate(by_boundary.begin(), by_boundary.end(), in);
  in = std::accumulate(by_applied.begin(), by_applied.end(), in);
  in = std::accumulate(by_surroundings.begin(), by_surroundings.end(), in);
  return std::abs(stored - in);
}

double Ledger::relative_residual() const {
  return turnover > 0 ? residual() / turnover : 0;
}

}  // namespace scree::thermal
