// Meshes of the shapes that need no file.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

// Box, sphere or cylinder with elements of about the body's mesh_size, or the coarsest mesh of the shape if that is larger.
// The flat faces are flat, and the nodes of a round face lie on it, to the last bit but one.
// Throws InputError if the shape does not exist in this dimension or would need more than 20 million elements.
template <int dim>
SimplexMesh<dim> mesh_shape(const BodySpec& body);

// Of the box, the sphere or the cylinder [m], beyond which a mesh size makes nothing coarser; infinite for a file.
double largest_length(const Shape& shape);

}  // namespace scree::mesh
