// What an earlier run left in the directory of this one.
#pragma once

#include "tools/run/run_context.h"

namespace scree::run {

// Removes all of it that must not be taken for this run's, unless this one goes on with it: to be called as soon as nothing of
// the scene can be refused any more. A packing stays, to be used again. Throws RunError.
void remove_earlier(const RunContext& context);

}  // namespace scree::run
