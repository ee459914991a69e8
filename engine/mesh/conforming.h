// Whether the elements of a mesh fit together: two that touch do so in a whole face of both, or not in a face at all.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/raw_mesh.h"

namespace scree::mesh {

// Throws InputError if faces that belong to one element only lie on each other: heat would not pass between the two elements,
// and both sides would count as the outside of the body. Such are faces cut along different diagonals, a large face beside
// small ones, a quadrilateral beside triangles. Linear in the number of elements. Faces that have no node in common are not
// looked at.
template <int dim>
void expect_conforming(const BodySpec& body, const RawMesh& raw);

}  // namespace scree::mesh
