// Wider instructions where the processor has them. Without fused operations they round like the plain ones.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
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

#ifdef SCREE_HAS_AVX2
template <class Body>
__attribute__((target("avx2"))) void with_avx2(const Body& body) {
  body();
}
#endif

// Calls body(), a lambda that is SCREE_INLINED, with wider instructions if there are any. Unlike a function that is SCREE_WIDE
// it may hold vectors as wide as these.
template <class Body>
void widely(const Body& body) {
#ifdef SCREE_HAS_AVX2
  if (__builtin_cpu_supports("avx2") != 0) {
    with_avx2(body);
    return;
  }
#endif
  body();
}

}  // namespace scree
