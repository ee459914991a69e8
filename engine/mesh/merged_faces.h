// A convex shell as a polyhedron whose faces are polygons.
#pragma once

#include "engine/mesh/convex_pieces.h"
#include "engine/mesh/shell.h"

namespace scree::mesh {

// By the first grouping of the triangles that makes convex polygons, none of them bent if another one does it; single triangles
// are convex.
ConvexPiece merged_faces(const Shell& shell);

// Between each two of its faces, all of them sharp and none inner.
void add_edges(ConvexPiece& piece);

}  // namespace scree::mesh
