// The faces of a tetrahedron.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// Corners, counter-clockwise seen from outside.
constexpr std::int32_t faces_of_tetrahedron[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// By which a face or an edge is found whatever element names it.
template <std::size_t count>
std::array<NodeId, count> sorted(std::array<NodeId, count> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace scree::mesh
