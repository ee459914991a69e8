#include "thermal/check_start.h"

#include "thermal/drive.h"
#include "thermal/steady_state.h"
#include "thermal/time_options.h"

namespace scree::thermal {

void check_start(const HeatModel& model, const TimeOptions& options) {
  Drives(model).at(0);
  if (options.steady) return check_steady(model);
  checked(options);
  if (options.integrator == Integrator::explicit_euler) explicit_step(model, options);
}

}  // namespace scree::thermal
