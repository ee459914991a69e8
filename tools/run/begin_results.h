// When a run makes the directory its own.
#pragma once

#include "tools/run/run_context.h"

namespace scree::run {

// Removes all that an earlier run left and nobody must take for this one's, unless this one goes on with it, and leaves the
// scene and a summary that says that the run has not ended. A packing stays, to be used again. To be called as soon as nothing
// of the scene can be refused any more, and before the first file; what has been begun is not begun again. Throws RunError.
void begin_results(RunContext& context);

}  // namespace scree::run
