// The names of the sides of shapes.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

// Gives every outer face of a meshed shape the name of its side: x_low x_high y_low y_high z_low z_high of a box (by the
// shape's own axes, before it is turned), surface of a sphere or disc, side bottom top of a cylinder. A mesh file has its own
// names.
template <int dim>
void name_surfaces(const Shape& shape, Parts<dim>& parts);

}  // namespace scree::mesh
