// Four or eight numbers in double precision that are worked on at once, by wide.h's instructions.
#pragma once

#include <cstring>

#include "engine/base/wide.h"

// All that takes or gives such numbers is inlined, so it is no matter how a call would pass them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scree {

inline constexpr int numbers_in_quad = 4;
using Quad = double __attribute__((vector_size(numbers_in_quad * sizeof(double))));
using Octet = double __attribute__((vector_size(2 * numbers_in_quad * sizeof(double))));

template <class Vector>
SCREE_INLINE void load(Vector& numbers, const double* from) {
  std::memcpy(&numbers, from, sizeof numbers);
}

template <class Vector>
SCREE_INLINE void store(const Vector& numbers, double* to) {
  std::memcpy(to, &numbers, sizeof numbers);
}

}  // namespace scree
