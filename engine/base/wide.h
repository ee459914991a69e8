// Wider instructions where the processor has them. Without fused operations they round like the plain ones.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
// For a function that is compiled twice. What it calls has to be inlined to gain by it.
#define SCREE_WIDE __attribute__((target_clones("avx2", "default")))
// For a function that is called only where __builtin_cpu_supports("avx2") says so; not defined where there is no such thing.
#define SCREE_AVX2 __attribute__((target("avx2")))
#else
#define SCREE_WIDE
#endif

#define SCREE_INLINE inline __attribute__((always_inline))
