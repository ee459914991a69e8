// Wider instructions where the processor has them. Without fused operations they round like the plain ones.
#pragma once

#include <type_traits>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
// For a function that is compiled twice. What it calls has to be inlined to gain by it.
#define SCREE_WIDE __attribute__((target_clones("avx2", "default")))
#define SCREE_HAS_AVX2
#else
#define SCREE_WIDE
#endif

// What is inlined into such functions wherever it is called; the second for lambdas, behind their parameters.
#define SCREE_INLINE inline __attribute__((always_inline))
#define SCREE_INLINED __attribute__((always_inline))

namespace scree {

// How long the longest vectors are that something is compiled for.
template <int count>
using VectorBytes = std::integral_constant<int, count>;

enum class Instructions { common, avx2, avx512 };

inline Instructions best_instructions() {
#ifdef SCREE_HAS_AVX2
  const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi") != 0 &&
                    __builtin_cpu_supports("bmi2") != 0 && __builtin_cpu_supports("popcnt") != 0;
  const bool avx512 = __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                      __builtin_cpu_supports("avx512vl") != 0;
  if (avx2) return avx512 ? Instructions::avx512 : Instructions::avx2;
#endif
  return Instructions::common;
}

// The best there are; tests ask for others.
inline Instructions instructions_in_use = best_instructions();

#ifdef SCREE_HAS_AVX2
template <class Body>
__attribute__((target("avx2,bmi,bmi2,popcnt"))) void with_avx2(const Body& body) {
  body(VectorBytes<32>{});
}

// What the compiler makes vectors of by itself is as long as with AVX2.
template <class Body>
__attribute__((target("avx2,bmi,bmi2,popcnt,avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=256"))) void with_avx512(
    const Body& body) {
  body(VectorBytes<64>{});
}
#endif

// Calls body(VectorBytes<...>()), a lambda that is SCREE_INLINED, with wider instructions if there are any. Unlike a function
// that is SCREE_WIDE it may hold vectors as long as these.
template <class Body>
void widely(const Body& body) {
#ifdef SCREE_HAS_AVX2
  if (instructions_in_use == Instructions::avx512) return with_avx512(body);
  if (instructions_in_use == Instructions::avx2) return with_avx2(body);
#endif
  body(VectorBytes<32>{});
}

}  // namespace scree
