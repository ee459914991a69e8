// How much of an element lies in a box.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// Of a simplex, exact but for rounding [m3] (2-D: [m2]).
template <int dim>
double volume_in_box(const BlockMesh<dim>& mesh, ElementId element, const Aabb<dim>& box);

}  // namespace scree::mesh
