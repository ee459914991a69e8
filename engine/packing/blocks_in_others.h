// Which blocks may lie in others, by boxes alone.
#pragma once

#include <vector>

#include "engine/packing/asked_pairs.h"

namespace scree::packing {

// Box of each block.
template <int dim>
Table<BlockId, Aabb<dim>> block_boxes(const mesh::BlockMesh<dim>& mesh);

// Blocks that reach into the box of another that makes a pair with them, or, of different bodies, into that of another body, by
// `depth` [m] along every axis; in their order. No other block is as deep in any.
std::vector<BlockId> blocks_in_others(const mesh::BlockMesh<3>& mesh, double depth, Pairs asked);

}  // namespace scree::packing
