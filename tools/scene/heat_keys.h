// The keys of the section heat.
#pragma once

#include <vector>

#include "engine/base/key_table.h"

namespace scree {

std::vector<Key> heat_keys();

}  // namespace scree
