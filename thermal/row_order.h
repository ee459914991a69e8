// An order of the rows of K in which neighbours in space are neighbours in memory, across blocks: a product then finds what it
// reads in the cache, and threads read little of what others wrote.
#pragma once

#include <algorithm>

#include "thermal/heat_model.h"
#include "thermal/row_bundles.h"

namespace scree::thermal {

inline constexpr std::size_t many_rows = 50'000;  // for which K is larger than caches

// Whether it pays: for many nodes, and for many blocks as small as a bundle (row_bundles.h). Meshes of cells come in the order
// of their grid, which is as good, and rows that repeat (row_runs.h) stay together in it.
template <int dim>
bool is_worth_ordering(const mesh::BlockMesh<dim>& mesh) {
  constexpr std::ptrdiff_t many_small_blocks = 500;
  if (!mesh.cells.empty()) return false;
  const auto is_small = [](const mesh::Block& block) { return block.nodes.size() <= rows_in_bundle; };
  return mesh.nodes.size() >= many_rows || std::count_if(mesh.blocks.begin(), mesh.blocks.end(), is_small) >= many_small_blocks;
}

// Nodes in the order that their rows should have. The rows of a block as small as a bundle stay together.
//  Many rows: by slabs across the longest side of all, in a slab by strips, in a strip by place, each about as thick as nodes
//  are apart. Fewer: by four regions of as many rows each, halves of halves across the longest side, so that threads share few
//  of them; in a region first those of larger blocks as they are, then the small blocks, halved likewise on and on.
// `blocks`: of every node of the mesh. `places`: of every node [m].
std::vector<NodeId> in_space_order(const std::vector<NodeId>& nodes, const Table<NodeId, BlockId>& blocks,
                                   const Eigen::Matrix3Xd& places);

}  // namespace scree::thermal
