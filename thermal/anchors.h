// Whether every block's temperature is tied to something given.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Throws InputError if blocks have no path, through blocks and contacts that conduct, to a fixed node or to surroundings; it
// names their bodies, how many they are, and what is put into them.
void check_anchors(const HeatModel& model);

}  // namespace scree::thermal
