// What needs VTK, behind one door. VTK with the graphics behind it takes longer to load than a small run, so all of it is in a
// library of its own (libscree_vtk.so) that is loaded by the first call: of `render`, `animate`, `read_vtu` or `read_stored`.
// Here is what the two sides know of each other; for this room only.
#pragma once

#include "engine/output/read_vtu.h"
#include "engine/output/render.h"
#include "engine/output/stored_field.h"

namespace scree::output {

// In the library, the functions of the same names in namespace vtk.
struct VtkRoom {
  double (*render)(const Picture&, const std::filesystem::path&);
  void (*animate)(const Picture&, const Film&, const std::filesystem::path&);
  mesh::RawMesh (*read_vtu)(const std::filesystem::path&);
  NodalField (*read_stored_2)(const StoredField&, const mesh::BlockMesh<2>&);
  NodalField (*read_stored_3)(const StoredField&, const mesh::BlockMesh<3>&);
};

namespace vtk {

double render(const Picture& picture, const std::filesystem::path& png);
void animate(const Picture& picture, const Film& film, const std::filesystem::path& video);
mesh::RawMesh read_vtu(const std::filesystem::path& file);
template <int dim>
NodalField read_stored(const StoredField& stored, const mesh::BlockMesh<dim>& mesh);

}  // namespace vtk

}  // namespace scree::output

// The door: what the library exports.
extern "C" const scree::output::VtkRoom* scree_vtk_room();
