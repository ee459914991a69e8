// What of a packing takes part in what comes after the fall: all blocks but those that left the scene.
#pragma once

#include "engine/packing/packing.h"

namespace scree::packing {

// Where blocks stand in the packing they are of.
struct Places {
  Table<BlockId, BlockId> blocks;         // the number of each there, ascending
  Table<BlockId, IdRange<NodeId>> nodes;  // of each there
  std::size_t all_nodes = 0;              // of the packing

  // Values of the blocks' nodes as values of the packing's; NaN where a block was lost.
  [[nodiscard]] std::vector<double> in_packing(const Eigen::VectorXd& values) const;
};

template <int dim>
struct Remaining {
  mesh::BlockMesh<dim> mesh;  // as placed
  Places places;
};

template <int dim>
Remaining<dim> remaining(const Packing<dim>& packing);

}  // namespace scree::packing
