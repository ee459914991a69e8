// Neighbours in memory that are worked on at once, by wide.h's instructions. (With AVX-512 products take twice as long: most of
// their loads cross a cache line.)
#pragma once

#include <cstring>

#include "engine/base/wide.h"

namespace scree::thermal {

inline constexpr int numbers_in_quad = 4;
using Quad = double __attribute__((vector_size(numbers_in_quad * sizeof(double))));

SCREE_INLINE void load(Quad& quad, const double* from) {
  std::memcpy(&quad, from, sizeof quad);
}

SCREE_INLINE void load(Quad& quad, const float* from) {
  float __attribute__((vector_size(numbers_in_quad * sizeof(float)))) values;
  std::memcpy(&values, from, sizeof values);
  quad = __builtin_convertvector(values, Quad);
}

SCREE_INLINE void store(const Quad& quad, double* to) {
  std::memcpy(to, &quad, sizeof quad);
}

}  // namespace scree::thermal
