// Shapes in quadrilaterals, wedges and hexahedra.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

// A rectangle in rows of quadrilaterals, about `mesh_size` long and all alike.
SimplexMesh<2> grid_of(const BodySpec& body, const Box& box);

// What stands above a plane mesh, in layers about the body's mesh_size high: wedges above triangles, hexahedra above
// quadrilaterals. Centred on z = 0.
SimplexMesh<3> extruded(const BodySpec& body, const SimplexMesh<2>& base, double height);

// Throws InputError for a kind of cell that this dimension does not have, or this shape cannot be made of.
template <int dim>
void check_cells(const BodySpec& body);

}  // namespace scree::mesh
