// How much of an element or a face lies in a box, and of a box's side in an element.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// A corner per column [m]: of an element (dim + 1 of them), or of a face (dim).
template <int dim, int corners>
using Corners = Eigen::Matrix<double, dim, corners>;

template <int dim, std::size_t corners>
Corners<dim, corners> corners_of(const BlockMesh<dim>& mesh, const std::array<NodeId, corners>& nodes) {
  Corners<dim, corners> places;
  for (std::size_t corner = 0; corner < corners; ++corner)
    places.col(static_cast<Eigen::Index>(corner)) = mesh.nodes[nodes[corner]];
  return places;
}

// Of each corner the integral, over the part of the simplex that lies in the box, of the linear function that is 1 there and 0
// at the others, exact but for rounding. Together they are the size of that part [m3] (of faces, and of elements in 2-D: [m2]).
// Corners nearer to a side than `rounding` [m] lie in it, and so may a face as a whole, which then counts.
template <int dim, int corners>
Eigen::Array<double, corners, 1> shares_in_box(const Corners<dim, corners>& simplex, const Aabb<dim>& box, double rounding);

// The same over the part of a side of the box that lies in an element, where the element reaches into the box from there: a
// face in the side counts for the element within. Corners nearer to a side than `rounding` [m] lie on it. Together [m2] (2-D:
// [m]).
template <int dim>
Eigen::Array<double, dim + 1, 1> shares_on_side(const Corners<dim, dim + 1>& element, const Aabb<dim>& box, int axis, bool high,
                                                double rounding);

}  // namespace scree::mesh
