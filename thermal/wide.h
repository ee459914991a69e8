// Wider instructions where the processor has them. Without fused operations they round like the plain ones. (With AVX-512
// products take twice as long: most of their loads cross a cache line.)
#pragma once

#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SCREE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SCREE_WIDE
#endif

#define SCREE_INLINE inline __attribute__((always_inline))

namespace scree::thermal {

// Neighbours in memory that are worked on at once.
inline constexpr int numbers_in_quad = 4;
using Quad = double __attribute__((vector_size(numbers_in_quad * sizeof(double))));

SCREE_INLINE void load(Quad& quad, const double* from) {
  std::memcpy(&quad, from, sizeof quad);
}

SCREE_INLINE void store(const Quad& quad, double* to) {
  std::memcpy(to, &quad, sizeof quad);
}

}  // namespace scree::thermal
