// Which boundary faces come near another block at all: of large blocks most do not, and nothing else is asked about those.
#pragma once

#include "contact/shell.h"

namespace scree::contact {

// Leaves out faces of blocks of many elements: those whose element comes near no other block's box. Kept are, in their order,
// the others, and those around them that share a node with one of them, so that normals at nodes and edges stay what they are.
template <int dim>
Table<FaceId, mesh::Face<dim>> near_faces(const mesh::BlockMesh<dim>& mesh, Table<FaceId, mesh::Face<dim>> faces,
                                          const ShellOptions& options);

}  // namespace scree::contact
