// Closed surfaces from a file: checked, refined and filled with tetrahedra.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

// One part per shell. The shape of a shell stays what it is: its triangles are only cut, until no edge is longer than 1.4 times
// the body's mesh_size. Which way they face does not matter, a closed surface has one inside.
// Triangles without area that two corners at one place or a corner on an edge have made are mended; the shape has no other.
// Throws InputError for open edges, edges with more than two triangles, other flat triangles, a shell inside another one (a
// hollow body), and a surface that cuts itself.
Parts<3> fill_surface(const BodySpec& body, RawMesh raw);

}  // namespace scree::mesh
