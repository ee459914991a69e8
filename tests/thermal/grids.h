// Boxes in grids of hexahedra.
#pragma once

#include "engine/mesh/make_blocks.h"

namespace scree::thermal::test {

// So many boxes in one place.
inline mesh::BlockMesh<3> boxes_of_hexahedra(const Eigen::Vector3d& size, double mesh_size, std::size_t count = 1) {
  mesh::BodySpec body;
  body.name = "box";
  body.shape = mesh::Box{.size = size};
  body.mesh_size = mesh_size;
  body.cells = mesh::CellKind::hexahedron;
  body.material = MaterialId{0};
  return mesh::make_blocks<3>(std::vector(count, body));
}

}  // namespace scree::thermal::test
