// Eight or sixteen numbers in single precision that are worked on at once, all of them with the same names (lanes_in.h). They
// are two or four fours: one of each of two shells, say. For functions that are compiled for wider instructions too (`widely`),
// into which all of this is inlined; with narrower ones eight cost more than two fours, and there are never sixteen.
#pragma once

#include <array>

#include "contact/coordinates.h"
#include "contact/lanes.h"
#include "engine/base/wide.h"

// All that takes or gives such numbers is inlined, here and where this is included, so it is no matter how a call would pass
// them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scree::contact {

using WideLanes = float __attribute__((vector_size(32)));
using WideMask = int __attribute__((vector_size(32)));
using WidestLanes = float __attribute__((vector_size(64)));
using WidestPlaces = int __attribute__((vector_size(64)));

SCREE_INLINE WideLanes joined(const Lanes& low, const Lanes& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

// Each four with its lanes in this order.
template <int i, int j, int k, int l>
SCREE_INLINE WideLanes ordered_fours(const WideLanes& a) {
  return __builtin_shufflevector(a, a, i, j, k, l, 4 + i, 4 + j, 4 + k, 4 + l);
}

// Each four's rows to columns.
SCREE_INLINE std::array<WideLanes, 4> transposed_fours(const WideLanes& a, const WideLanes& b, const WideLanes& c,
                                                       const WideLanes& d) {
  const WideLanes low_ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const WideLanes low_cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const WideLanes high_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const WideLanes high_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return {__builtin_shufflevector(low_ab, low_cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(low_ab, low_cd, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(high_ab, high_cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(high_ab, high_cd, 2, 3, 10, 11, 6, 7, 14, 15)};
}

SCREE_INLINE WideLanes least(const WideLanes& a, const WideLanes& b) {
  return a < b ? a : b;
}
SCREE_INLINE WideLanes most(const WideLanes& a, const WideLanes& b) {
  return a > b ? a : b;
}

// Masks of eight, as wide as the lanes.
SCREE_INLINE WideMask below(const WideLanes& a, const WideLanes& b) {
  return a < b;
}
SCREE_INLINE WideMask at_most(const WideLanes& a, const WideLanes& b) {
  return a <= b;
}

// Bit i for lane i.
SCREE_INLINE unsigned bits(const WideMask& mask) {
  const LaneMask low = __builtin_shufflevector(mask, mask, 0, 1, 2, 3), high = __builtin_shufflevector(mask, mask, 4, 5, 6, 7);
  return bits(low) | bits(high) << lane_count;
}

SCREE_INLINE void put_in_a_row(const std::array<Lanes, 2>& fours, WideLanes& into) {
  into = joined(fours[0], fours[1]);
}
SCREE_INLINE void put_in_fours(const std::array<float, 2>& numbers, WideLanes& into) {
  into = joined(all_lanes(numbers[0]), all_lanes(numbers[1]));
}
SCREE_INLINE void put_in_a_row(const std::array<WideLanes, 1>& eights, WideLanes& into) {
  into = eights[0];
}
SCREE_INLINE void take_apart(const WideLanes& a, std::array<WideLanes, 1>& eights) {
  eights[0] = a;
}
SCREE_INLINE void repeat(const Lanes& a, WideLanes& into) {
  into = joined(a, a);
}
SCREE_INLINE void repeat(float a, WideLanes& into) {
  into = WideLanes{a, a, a, a, a, a, a, a};
}

#ifdef SCREE_HAS_AVX2
template <int i, int j, int k, int l>
SCREE_INLINE WidestLanes ordered_fours(const WidestLanes& a) {
  return __builtin_shufflevector(a, a, i, j, k, l, 4 + i, 4 + j, 4 + k, 4 + l, 8 + i, 8 + j, 8 + k, 8 + l, 12 + i, 12 + j,
                                 12 + k, 12 + l);
}

template <int first, int second>
SCREE_INLINE WidestLanes unpacked(const WidestLanes& a, const WidestLanes& b) {
  return __builtin_shufflevector(a, b, first, 16 + first, second, 16 + second, 4 + first, 20 + first, 4 + second, 20 + second,
                                 8 + first, 24 + first, 8 + second, 24 + second, 12 + first, 28 + first, 12 + second,
                                 28 + second);
}
template <int first, int second>
SCREE_INLINE WidestLanes paired(const WidestLanes& a, const WidestLanes& b) {
  return __builtin_shufflevector(a, b, first, second, 16 + first, 16 + second, 4 + first, 4 + second, 20 + first, 20 + second,
                                 8 + first, 8 + second, 24 + first, 24 + second, 12 + first, 12 + second, 28 + first,
                                 28 + second);
}
SCREE_INLINE std::array<WidestLanes, 4> transposed_fours(const WidestLanes& a, const WidestLanes& b, const WidestLanes& c,
                                                         const WidestLanes& d) {
  const WidestLanes low_ab = unpacked<0, 1>(a, b), low_cd = unpacked<0, 1>(c, d);
  const WidestLanes high_ab = unpacked<2, 3>(a, b), high_cd = unpacked<2, 3>(c, d);
  return {paired<0, 1>(low_ab, low_cd), paired<2, 3>(low_ab, low_cd), paired<0, 1>(high_ab, high_cd),
          paired<2, 3>(high_ab, high_cd)};
}

// Masks of sixteen are of one bit a lane, as those of eight in double precision (coordinates.h).
SCREE_INLINE WidestLanes least(const WidestLanes& a, const WidestLanes& b) {
  return __builtin_ia32_minps512_mask(a, b, a, -1, rounding_as_set);
}
SCREE_INLINE WidestLanes most(const WidestLanes& a, const WidestLanes& b) {
  return __builtin_ia32_maxps512_mask(a, b, a, -1, rounding_as_set);
}
SCREE_INLINE unsigned below(const WidestLanes& a, const WidestLanes& b) {
  return __builtin_ia32_cmpps512_mask(a, b, 1, 0xffff, rounding_as_set);
}
SCREE_INLINE unsigned at_most(const WidestLanes& a, const WidestLanes& b) {
  return __builtin_ia32_cmpps512_mask(a, b, 2, 0xffff, rounding_as_set);
}

// Not by way of memory, where a load of all would wait for the stores of each.
SCREE_INLINE void put_in_a_row(const std::array<WideLanes, 2>& eights, WidestLanes& into) {
  const WidestLanes low = __builtin_ia32_ps512_256ps(eights[0]);
  into = __builtin_ia32_insertf32x8_mask(low, eights[1], 1, low, -1);
}
SCREE_INLINE void put_in_a_row(const std::array<Lanes, 4>& fours, WidestLanes& into) {
  const auto both = [&](int first) SCREE_INLINED {
    return __builtin_ia32_vinsertf128_ps256(__builtin_ia32_ps256_ps(fours[first]), fours[first + 1], 1);
  };
  put_in_a_row(std::array<WideLanes, 2>{both(0), both(2)}, into);
}
SCREE_INLINE void put_in_fours(const std::array<float, 4>& numbers, WidestLanes& into) {
  into = __builtin_ia32_broadcastss512(all_lanes(numbers[0]), WidestLanes{}, -1);
  into = __builtin_ia32_broadcastss512(all_lanes(numbers[1]), into, 0xf0);
  into = __builtin_ia32_broadcastss512(all_lanes(numbers[2]), into, 0xf00);
  into = __builtin_ia32_broadcastss512(all_lanes(numbers[3]), into, static_cast<short>(0xf000));
}
SCREE_INLINE void take_apart(const WidestLanes& a, std::array<WideLanes, 2>& eights) {
  eights[0] = __builtin_ia32_extractf32x8_mask(a, 0, WideLanes{}, -1);
  eights[1] = __builtin_ia32_extractf32x8_mask(a, 1, WideLanes{}, -1);
}
SCREE_INLINE void repeat(const Lanes& a, WidestLanes& into) {
  into = __builtin_ia32_broadcastf32x4_512(a, WidestLanes{}, -1);
}
SCREE_INLINE void repeat(float a, WidestLanes& into) {
  into = __builtin_ia32_broadcastss512(all_lanes(a), WidestLanes{}, -1);
}
#endif
SCREE_INLINE unsigned bits(unsigned mask) {
#ifdef SCREE_HAS_AVX2
  // Into a common register at once: put aside in memory a mask has fewer bytes than are read back, which takes long.
  asm("" : "+r"(mask));
#endif
  return mask;
}

}  // namespace scree::contact
