// Eight numbers in single precision that are worked on at once as the four of lanes.h are, for functions that are compiled for
// wider instructions only: by others they cost far more than two fours.
#pragma once

#include <array>
#include <type_traits>

#include "contact/lanes.h"
#include "engine/base/wide.h"

// All that takes or gives such numbers is inlined, here and where this is included, so it is no matter how a call would pass
// them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace scree::contact {

using WideLanes = float __attribute__((vector_size(32)));
using WideMask = int __attribute__((vector_size(32)));

SCREE_INLINE WideLanes joined(const Lanes& low, const Lanes& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

// Bit i for lane i.
SCREE_INLINE unsigned bits(const WideMask& mask) {
  const LaneMask low = __builtin_shufflevector(mask, mask, 0, 1, 2, 3), high = __builtin_shufflevector(mask, mask, 4, 5, 6, 7);
  return bits(low) | bits(high) << lane_count;
}

// Four numbers or eight.
template <class Numbers>
inline constexpr int count_of = sizeof(Numbers) / sizeof(float);

// Points or directions, one a lane, axis by axis.
template <class Numbers>
using Points = std::array<Numbers, 3>;

template <class Numbers>
SCREE_INLINE Numbers dot(const Points<Numbers>& a, const Points<Numbers>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Numbers>
SCREE_INLINE Points<Numbers> cross(const Points<Numbers>& a, const Points<Numbers>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// At least the length of a vector and at most 1.16 times as much, without a root, which is slow and cannot be taken of eight
// numbers where functions are compiled for four as well.
template <class Numbers>
SCREE_INLINE Numbers most_length(const Points<Numbers>& vector) {
  const auto larger = [](const Numbers& a, const Numbers& b) { return a > b ? a : b; };
  const auto absolute = [&](const Numbers& a) { return larger(a, -a); };
  const Numbers x = absolute(vector[0]), y = absolute(vector[1]), z = absolute(vector[2]);
  return 0.5F * (x + y + z + larger(x, larger(y, z)));
}

// Is a place from the start to the end, or not more than `beyond` off?
template <class Numbers>
SCREE_INLINE auto within(const Numbers& along, const Numbers& end, const Numbers& beyond) {
  return (along >= -beyond) & (along <= end + beyond);
}

template <class Numbers>
SCREE_INLINE Points<Numbers> minus(const Points<Numbers>& a, const Points<Numbers>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Numbers>
using MaskOf = std::conditional_t<count_of<Numbers> == lane_count, LaneMask, WideMask>;

SCREE_INLINE LaneMask together(const std::array<int, lane_count>& n) {
  return LaneMask{n[0], n[1], n[2], n[3]};
}
SCREE_INLINE WideMask together(const std::array<int, 2 * lane_count>& n) {
  return WideMask{n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]};
}

// In each lane that of four points whose number the lowest two bits say; others may be set.
template <class Numbers>
SCREE_INLINE Points<Numbers> picked(const LanePoints<3>& points, const MaskOf<Numbers>& numbers) {
  if constexpr (count_of<Numbers> == lane_count) {
    return {shuffled(points[0], numbers), shuffled(points[1], numbers), shuffled(points[2], numbers)};
  } else {
    const auto twice = [&](const Lanes& axis) { return __builtin_shuffle(joined(axis, axis), numbers); };
    return {twice(points[0]), twice(points[1]), twice(points[2])};
  }
}

}  // namespace scree::contact
