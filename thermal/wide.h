// Wider instructions where the processor has them. Without fused operations they round like the plain ones. (With AVX-512
// products take twice as long: most of their loads cross a cache line.)
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SCREE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SCREE_WIDE
#endif

#define SCREE_INLINE inline __attribute__((always_inline))
