// Four numbers in double precision that are worked on at once, by wide.h's instructions.
#pragma once

#include <cstring>

#include "engine/base/wide.h"

// All that takes or gives such numbers is inlined, so it is no matter how a call would pass them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scree {

inline constexpr int numbers_in_quad = 4;
using Quad = double __attribute__((vector_size(numbers_in_quad * sizeof(double))));

SCREE_INLINE void load(Quad& quad, const double* from) {
  std::memcpy(&quad, from, sizeof quad);
}

SCREE_INLINE void store(const Quad& quad, double* to) {
  std::memcpy(to, &quad, sizeof quad);
}

}  // namespace scree
