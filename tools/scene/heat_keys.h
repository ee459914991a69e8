// The keys of the section heat.
#pragma once

#include <array>
#include <vector>

#include "engine/base/key_table.h"

namespace scree {

std::vector<Key> heat_keys();

// Of heat.integrator, in the order of thermal::Integrator.
inline constexpr std::array integrator_words{"automatic", "implicit", "stabilised_explicit", "explicit_euler"};

}  // namespace scree
