// Meshes from VTK's unstructured grid files, as bodies; VTK stays in this room.
#pragma once

#include <filesystem>

#include "engine/mesh/raw_mesh.h"

namespace scree::output {

// The points and elements of a .vtu file, both numbered from 0. Throws std::runtime_error with VTK's reason if it cannot be
// read.
mesh::RawMesh read_vtu(const std::filesystem::path& file);

// What mesh::make_blocks needs to read every kind of file that Scree reads.
mesh::MeshReaders mesh_readers();

}  // namespace scree::output
