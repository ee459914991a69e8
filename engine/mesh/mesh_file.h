// Bodies that come from a file.
#pragma once

#include <string>

#include "engine/mesh/body_spec.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

// By which its format is told: ".stl", whether it is written large or small.
std::string extension_of(const MeshFile& file);

// Reads the body's file and checks it. A volume mesh (2-D: of triangles) is used as it is; a closed surface (3-D) is meshed
// inside with the body's mesh_size. Gives one part per connected piece. Throws InputError for all that is wrong with the file.
template <int dim>
Parts<dim> mesh_file(const BodySpec& body, const MeshReaders& readers);

}  // namespace scree::mesh
