// The value of a field at a point from a cubic polynomial through its nodes around: what a grid whose nodes are exact to the
// fourth order needs to be read with. Straight lines between nodes miss T'' h^2/8, whatever the nodes are worth.
#pragma once

#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::output {

// sum_i weights[i] T(nodes[i]).
struct Stencil {
  std::vector<NodeId> nodes;
  std::vector<double> weights;
};

// At a point in a quadrilateral or hexahedron of the block, from the nodes within some cells of its size around, counted along
// its edges and from cell to cell: what lies across a slot is far away. Least squares, near nodes counting most. In a grid of
// four layers or more along each axis it is exact for cubic fields; along an axis with fewer, for what these determine (two: a
// line). Where nodes are few otherwise, for quadratic fields; empty where not even those are determined.
template <int dim>
Stencil cubic_stencil(const mesh::BlockMesh<dim>& mesh, BlockId block, CellId cell, const Point<dim>& point);

}  // namespace scree::output
