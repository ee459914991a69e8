// Four numbers in single precision that are worked on at once: the vertices or the planes of an element. A triangle leaves the
// last one unused.
//
// What is found so is a bound only, widened by the rounding, and what may touch is then asked in double precision: no result
// has a rounding of single precision in it.
#pragma once

#include <array>

namespace scree::contact {

using Lanes = float __attribute__((vector_size(16)));
using LaneMask = int __attribute__((vector_size(16)));  // all bits of a lane or none, as comparisons give them

inline constexpr int lane_count = 4;

inline Lanes all_lanes(float value) {
  return Lanes{value, value, value, value};
}

inline Lanes least(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
inline Lanes most(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}
inline Lanes absolute(const Lanes& a) {
  return most(a, -a);
}

inline float least_lane(const Lanes& a) {
  const float first = a[0] < a[1] ? a[0] : a[1], last = a[2] < a[3] ? a[2] : a[3];
  return first < last ? first : last;
}

// Bit i for lane i.
inline unsigned bits(const LaneMask& mask) {
#ifdef __SSE__
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<const Lanes&>(mask)));
#else
  unsigned found = 0;
  for (int i = 0; i < lane_count; ++i) found |= (mask[i] != 0 ? 1u : 0u) << i;
  return found;
#endif
}

// Points or directions, one a lane, axis by axis.
template <int dim>
using LanePoints = std::array<Lanes, dim>;

template <int dim>
Lanes dot(const LanePoints<dim>& a, const LanePoints<dim>& b) {
  Lanes sum = a[0] * b[0];
  for (int i = 1; i < dim; ++i) sum += a[i] * b[i];
  return sum;
}

// Rows to columns.
inline std::array<Lanes, 4> transposed(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  const Lanes low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Lanes low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5), high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5), __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7),
          __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5), __builtin_shufflevector(high_ab, high_cd, 2, 3, 6, 7)};
}

}  // namespace scree::contact
