// The faces of cells that belong to one of them only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "engine/mesh/cell_kind.h"
#include "engine/mesh/lone_faces.h"

namespace scree::mesh {

// The triangles that make up a face, by its corners; of a quadrilateral those of both diagonals.
std::span<const std::array<std::size_t, 3>> face_triangles(std::size_t corners);

// Calls `visit` with the place of the cell and the corners of the face, in this order. `cells` have a kind and nodes; `index`
// numbers their nodes from 0 to `nodes`.
template <class Cells, class Index, class Visit>
void for_each_outer_face(const Cells& cells, std::size_t nodes, const Index& index, const Visit& visit) {
  const auto for_each_face = [&](const auto& take) {
    std::uint32_t place = 0;
    for (const auto& cell : cells) {
      for (const CornerList corners : cell_faces(cell.kind)) {
        std::array<std::uint32_t, 4> face;  // of a triangle the greatest node twice
        std::transform(corners.begin(), corners.end(), face.begin(),
                       [&](std::size_t corner) { return static_cast<std::uint32_t>(index(cell.nodes[corner])); });
        if (corners.size() < 4) face[3] = *std::max_element(face.begin(), face.begin() + 3);
        std::sort(face.begin(), face.end());
        take(face, place++);
      }
    }
  };
  std::size_t cell = 0, before = 0;  // faces of the cells before
  for (const std::uint32_t place : lone_faces<4>(nodes, for_each_face)) {
    for (; place - before >= cell_faces(cells[cell].kind).size(); ++cell) before += cell_faces(cells[cell].kind).size();
    visit(cell, cell_faces(cells[cell].kind)[place - before]);
  }
}

}  // namespace scree::mesh
