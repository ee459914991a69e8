// Perfect joints whose two sides are held.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Throws InputError for a perfect joint that is held at different temperatures on its two sides, at any time up to the end of
// the run [s] as far as looks tell: the heat that would flow there has no bound, and what came out would be that of the mesh.
void check_held_joints(const JointConduction& joints, const HeatModel& model, double until);

}  // namespace scree::thermal
