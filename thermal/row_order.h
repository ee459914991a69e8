// An order of the rows of K in which neighbours in space are neighbours in memory, across blocks: a product then finds what it
// reads in the cache, and several products in a row can share what they read (row_tiles.h).
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Whether it pays: for K larger than caches. Meshes of cells come in the order of their grid, which is as good, and rows that
// repeat (row_runs.h) stay together in it.
template <int dim>
bool is_worth_ordering(const mesh::BlockMesh<dim>& mesh) {
  constexpr std::size_t many_nodes = 50'000;
  return mesh.nodes.size() >= many_nodes && mesh.cells.empty();
}

// Nodes in the order that their rows should have: by slabs across the longest side of all, in a slab by strips, in a strip by
// place, each about as thick as nodes are apart. The rows of a block as small as a bundle (row_bundles.h) stay together.
// `blocks`: of every node of the mesh. `places`: of every node [m].
std::vector<NodeId> in_space_order(std::vector<NodeId> nodes, const Table<NodeId, BlockId>& blocks,
                                   const Eigen::Matrix3Xd& places);

}  // namespace scree::thermal
