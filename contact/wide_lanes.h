// Eight numbers in single precision that are worked on at once: those of two shells, or of eight pairs of edges. For functions
// that are compiled for wider instructions too (SCREE_WIDE), into which all of this is inlined; with narrower ones it costs
// more than two fours.
#pragma once

#include <array>
#include <utility>

#include "contact/lanes.h"
#include "engine/base/wide.h"

// All that takes or gives such numbers is inlined, here and where this is included, so it is no matter how a call would pass
// them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scree::contact {

using WideLanes = float __attribute__((vector_size(32)));
using WideMask = int __attribute__((vector_size(32)));

inline constexpr int wide_count = 8;

SCREE_INLINE WideLanes joined(const Lanes& low, const Lanes& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
SCREE_INLINE WideLanes joined(float low, float high) {
  return joined(all_lanes(low), all_lanes(high));
}

SCREE_INLINE Lanes low_half(const WideLanes& lanes) {
  return __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
}
SCREE_INLINE Lanes high_half(const WideLanes& lanes) {
  return __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
}

// Of each half one lane in all of them.
template <int lane>
SCREE_INLINE WideLanes in_halves(const WideLanes& lanes) {
  return __builtin_shufflevector(lanes, lanes, lane, lane, lane, lane, 4 + lane, 4 + lane, 4 + lane, 4 + lane);
}

// Each half's rows to columns.
SCREE_INLINE std::array<WideLanes, 4> transposed_halves(const WideLanes& a, const WideLanes& b, const WideLanes& c,
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
SCREE_INLINE WideLanes absolute(const WideLanes& a) {
  return most(a, -a);
}

// Lane i is lane places[i] of a, of which the lowest three bits count.
SCREE_INLINE WideLanes shuffled(const WideLanes& a, const WideMask& places) {
#ifdef __clang__
  WideLanes result;
  for (int i = 0; i < wide_count; ++i) result[i] = a[places[i] & 7];
  return result;
#else
  return __builtin_shuffle(a, places);
#endif
}

// Bit i for lane i.
SCREE_INLINE unsigned bits(const WideMask& mask) {
  const LaneMask low = __builtin_shufflevector(mask, mask, 0, 1, 2, 3), high = __builtin_shufflevector(mask, mask, 4, 5, 6, 7);
  return bits(low) | bits(high) << lane_count;
}

// Calls visit(integral constant) for 0 to count - 1.
template <int count, class Visit>
SCREE_INLINE void for_each_constant(const Visit& visit) {
  [&]<int... i>(std::integer_sequence<int, i...>) SCREE_INLINED {
    (visit(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, count>{});
}

// Points or directions, one a lane, axis by axis.
using WidePoints = std::array<WideLanes, 3>;

SCREE_INLINE WidePoints joined(const LanePoints<3>& low, const LanePoints<3>& high) {
  return {joined(low[0], high[0]), joined(low[1], high[1]), joined(low[2], high[2])};
}

SCREE_INLINE WideLanes dot(const WidePoints& a, const WidePoints& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

SCREE_INLINE WidePoints cross(const WidePoints& a, const WidePoints& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

SCREE_INLINE WidePoints minus(const WidePoints& a, const WidePoints& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// At least the length of a vector and at most 1.16 times as much, without a root, which is slow.
SCREE_INLINE WideLanes most_length(const WidePoints& vector) {
  const WideLanes x = absolute(vector[0]), y = absolute(vector[1]), z = absolute(vector[2]);
  return 0.5F * (x + y + z + most(x, most(y, z)));
}

// Is a place from the start to the end, or not more than `beyond` off?
SCREE_INLINE WideMask within(const WideLanes& along, const WideLanes& end, const WideLanes& beyond) {
  return (along >= -beyond) & (along <= end + beyond);
}

// In each lane that of eight points whose number the lowest three bits say.
SCREE_INLINE WidePoints picked(const WidePoints& points, const WideMask& numbers) {
  return {shuffled(points[0], numbers), shuffled(points[1], numbers), shuffled(points[2], numbers)};
}

}  // namespace scree::contact
