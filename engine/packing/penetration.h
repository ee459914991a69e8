// How deep blocks are in each other, on the true geometry: a measure of a packing that no physics engine has a part in.
#pragma once

#include <cstddef>
#include <span>

#include "engine/packing/near_pieces.h"

namespace scree::packing {

struct Penetration {
  double max = 0;            // [m]
  double mean = 0;           // over the pairs that touch [m]
  std::size_t touching = 0;  // pairs of blocks nearer than the contact range, or overlapping
  BlockId first, second;     // the pair that holds the maximum; not valid if nothing overlaps
};

// The depth of a pair is the least translation that would part it, by
// separating axes (separation.h); of blocks in several convex pieces, the deepest of their pairs of pieces. A pair touches if
// it is nearer than `contact_range` [m]. Blocks that are lost (ascending) count for nothing: they stay where they left the
// scene, whatever else was lost there.
Penetration measure_penetration(const PieceSet& pieces, double contact_range, std::span<const BlockId> lost = {},
                                Pairs asked = Pairs::with_a_free_block);

}  // namespace scree::packing
