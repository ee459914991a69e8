// How far around heat has to go in a block that is bent.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::thermal {

// How many times as far it is from one end of a block to the place that is furthest along the edges of its elements as to the
// one that is furthest straight. Edges zigzag: up to 1.4 in a block that is not bent.
template <int dim>
double detour(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block);

}  // namespace scree::thermal
