// What a run reads must not lie where it writes.
#pragma once

#include "tools/run/run_files.h"
#include "tools/scene/scene.h"

namespace scree::run {

// Throws InputError for a directory in which the results of a run that starts would take the place of what it is made from:
// temperatures, tables or meshes among the results of an earlier run there; or in which no run has been and files of the names
// that it would write are.
void refuse_own_inputs(const Scene& scene, const RunFiles& files);

}  // namespace scree::run
