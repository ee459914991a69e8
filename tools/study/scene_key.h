// What a key of a scene takes, found by its path.
#pragma once

#include <string>

#include "engine/base/key_table.h"

namespace scree::study {

// The row of `heat.boundaries[0].temperature` or `heat.boundaries.0.temperature`; nothing if there is none.
const Key* scene_key(const std::string& path);

}  // namespace scree::study
