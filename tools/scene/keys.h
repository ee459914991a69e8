// Every key of a scene file.
#pragma once

#include "engine/base/key_table.h"

namespace scree {

const KeyTable& scene_keys();

}  // namespace scree
