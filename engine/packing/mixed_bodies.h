// Where bodies reach into each other's boxes: elsewhere none can be in another.
#pragma once

#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::packing {

// Blocks that reach into the box of another body than their own by more than `depth` [m] along every axis, in their order.
// Linear in the blocks where few bodies do.
template <int dim>
std::vector<BlockId> blocks_in_other_bodies(const mesh::BlockMesh<dim>& mesh, double depth);

}  // namespace scree::packing
