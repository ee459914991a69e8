// Bodies to blocks: the one entry point of the mesher.
#pragma once

#include <vector>

#include "engine/mesh/block_mesh.h"
#include "engine/mesh/body_spec.h"
#include "engine/mesh/raw_mesh.h"

namespace scree::mesh {

// Meshes every body and breaks it into blocks, in the order of `bodies`, copy by copy. The same specs give the same mesh, to
// the bit. `readers` add kinds of mesh files to .msh and .stl, which are read here.
// Throws InputError, naming the body, for a missing or unreadable mesh file, a surface that is not closed, a volume mesh with
// an inverted or empty element, duplicate or loose nodes, a shape that does not exist in this dimension, or copies that do not
// fit their region. A mesh file of several loose parts gives one block per part.
template <int dim>
BlockMesh<dim> make_blocks(const std::vector<BodySpec>& bodies, const MeshReaders& readers = {});

}  // namespace scree::mesh
