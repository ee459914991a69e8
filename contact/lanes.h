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

}  // namespace scree::contact
