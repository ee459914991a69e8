// Eight numbers in single precision that are worked on at once as the four of lanes.h are, for functions that are compiled for
// wider instructions only: by others they cost far more than two fours.
#pragma once

#include <array>

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

SCREE_INLINE WideLanes root(const WideLanes& square) {
  const Lanes low = __builtin_shufflevector(square, square, 0, 1, 2, 3);
  const Lanes high = __builtin_shufflevector(square, square, 4, 5, 6, 7);
  return joined(root(low), root(high));
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

// Is a place from the start to the end, or not more than `beyond` off?
template <class Numbers>
SCREE_INLINE auto within(const Numbers& along, const Numbers& end, const Numbers& beyond) {
  return (along >= -beyond) & (along <= end + beyond);
}

// Rows of three axes, row(i) each, to columns.
template <class Numbers, class Row>
SCREE_INLINE Points<Numbers> columns(const Row& row) {
  if constexpr (count_of<Numbers> == lane_count) {
    const auto all = transposed(row(0), row(1), row(2), row(3));
    return {all[0], all[1], all[2]};
  } else {
    const WideLanes a = joined(row(0), row(4)), b = joined(row(1), row(5)), c = joined(row(2), row(6)),
                    d = joined(row(3), row(7));
    const WideLanes low_ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const WideLanes low_cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const WideLanes high_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const WideLanes high_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    return {__builtin_shufflevector(low_ab, low_cd, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(low_ab, low_cd, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(high_ab, high_cd, 0, 1, 8, 9, 4, 5, 12, 13)};
  }
}

}  // namespace scree::contact
