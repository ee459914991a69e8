// The convex pieces of all blocks where they lie, and which of them are near each other.
#pragma once

#include <vector>

#include "engine/packing/asked_pairs.h"
#include "engine/packing/separation.h"

namespace scree::packing {

struct Part : Owner {
  PlacedPiece placed;
  Aabb<3> box;
};

// The pieces of a mesh and where they are; `parts` point into `pieces`, so that a copy would point into the original.
struct PieceSet {
  explicit PieceSet(const mesh::BlockMesh<3>& placed_mesh);
  PieceSet(const mesh::BlockMesh<3>& placed_mesh, const std::vector<BlockId>& blocks);  // of these only
  PieceSet(const PieceSet&) = delete;
  PieceSet& operator=(const PieceSet&) = delete;

  Table<BlockId, std::vector<mesh::ConvexPiece>> pieces;
  std::vector<Part> parts;  // in the order of the blocks
};

// Two parts of different blocks, with boxes nearer than `range` [m], in no order that means anything.
std::vector<std::pair<const Part*, const Part*>> near_pairs(const std::vector<Part>& parts, double range,
                                                            Pairs asked = Pairs::with_a_free_block);

}  // namespace scree::packing
