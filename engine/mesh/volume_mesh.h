// A volume mesh from a file: sound or refused, and its loose parts.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

// The parts of the mesh that share no node, in the order of their first elements. Throws InputError for an inverted or empty
// element, for elements that lie on the same side of a face, for such as do not fit together (conforming.h) unless each is to
// be a block of its own, and for a triangle apart from the tetrahedra.
template <int dim>
Parts<dim> checked_volume(const BodySpec& body, const RawMesh& raw);

}  // namespace scree::mesh
