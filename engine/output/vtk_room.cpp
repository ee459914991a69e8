#include "engine/output/vtk_room.h"

#include "engine/base/late_library.h"

namespace scree::output {

namespace {

const VtkRoom& room() {
  static const VtkRoom* const found = late_function<decltype(scree_vtk_room)>("libscree_vtk.so", "scree_vtk_room")();
  return *found;
}

}  // namespace

double render(const Picture& picture, const std::filesystem::path& png) {
  return room().render(picture, png);
}

void animate(const Picture& picture, const Film& film, const std::filesystem::path& video) {
  room().animate(picture, film, video);
}

mesh::RawMesh read_vtu(const std::filesystem::path& file) {
  return room().read_vtu(file);
}

mesh::MeshReaders mesh_readers() {
  return {{".vtu", read_vtu}};
}

template <>
NodalField read_stored(const StoredField& stored, const mesh::BlockMesh<2>& mesh) {
  return room().read_stored_2(stored, mesh);
}
template <>
NodalField read_stored(const StoredField& stored, const mesh::BlockMesh<3>& mesh) {
  return room().read_stored_3(stored, mesh);
}

}  // namespace scree::output
