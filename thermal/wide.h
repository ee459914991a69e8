// Neighbours in memory that are worked on at once. (With AVX-512 products take twice as long: most of their loads cross a cache
// line.)
#pragma once

#include "engine/base/quad.h"

namespace scree::thermal {

SCREE_INLINE void load(Quad& quad, const float* from) {
  float __attribute__((vector_size(numbers_in_quad * sizeof(float)))) values;
  std::memcpy(&values, from, sizeof values);
  quad = __builtin_convertvector(values, Quad);
}
using scree::load;

}  // namespace scree::thermal
