// Pairs of an edge of one tetrahedron with an edge of another, as sets of bits.
#pragma once

#include <array>
#include <cstdint>

namespace scree::contact {

// Bit 6 i + j: edge i of the first with edge j of the second.
using EdgePairs = std::uint64_t;

// Bit i of six to bit 6 i.
inline constexpr std::array<EdgePairs, 64> spread = [] {
  std::array<EdgePairs, 64> sets{};
  for (unsigned edges = 0; edges < 64; ++edges) {
    for (unsigned i = 0; i < 6; ++i) sets[edges] |= EdgePairs{edges >> i & 1u} << 6 * i;
  }
  return sets;
}();

// All pairs of these edges of the first.
inline EdgePairs pairs_of_first(unsigned edges) {
  return spread[edges] * 63;
}

// All pairs of these edges of the second.
inline EdgePairs pairs_of_second(unsigned edges) {
  return spread[63] * edges;
}

}  // namespace scree::contact
