// A run that is to be made anew in its folder.
#pragma once

#include "tools/run/run_files.h"

namespace scree::run {

// Removes what a run has left there, but for its packing, which is used again where it fits.
void forget_run(const RunFiles& files);

}  // namespace scree::run
