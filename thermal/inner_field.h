// Where heat goes in a block with dents: bent, with a slit, or with a narrow neck.
#pragma once

#include "thermal/block_conduction.h"
#include "thermal/heat_model.h"

namespace scree::thermal {

// Whether the surface of a block is indented at an edge (2-D: a corner), by more than what counts as convex (shell.h).
template <int dim>
bool is_dented(const mesh::BlockMesh<dim>& mesh, BlockId block);

// G of inner_resistance.h by linear elements on the block's own mesh.
template <int dim>
class InnerField {
 public:
  // Conductivity in W/m/K.
  InnerField(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block, const Tensor<dim>& conductivity);

  // Largest |G| at a node [K/W], the heat entering the nodes of the block by these shares, which sum to 1.
  [[nodiscard]] double largest(const Eigen::VectorXd& entering) const;

 private:
  SparseMatrix conductance_;  // [W/K]
  Eigen::VectorXd stored_;    // share of each node in the volume
};

}  // namespace scree::thermal
