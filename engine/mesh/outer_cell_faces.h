// The faces of cells that belong to one of them only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/mesh/cell_kind.h"

namespace scree::mesh {

// The triangles that make up a face, by its corners; of a quadrilateral those of both diagonals.
std::span<const std::array<std::size_t, 3>> face_triangles(std::size_t corners);

// Calls `visit` with the place of the cell and the corners of the face. `cells` have a kind and nodes.
template <class Cells, class Visit>
void for_each_outer_face(const Cells& cells, const Visit& visit) {
  using Node = std::decay_t<decltype(cells[0].nodes[0])>;
  struct Use {
    std::array<Node, 4> key;  // ascending; of a triangle the last one twice
    std::size_t cell;
    std::size_t face;

    auto operator<=>(const Use&) const = default;
  };
  std::vector<Use> uses;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t f = 0; f < cell_faces(cells[c].kind).size(); ++f) {
      const CornerList corners = cell_faces(cells[c].kind)[f];
      Use use{{}, c, f};
      std::transform(corners.begin(), corners.end(), use.key.begin(),
                     [&](std::size_t corner) { return cells[c].nodes[corner]; });
      if (corners.size() < 4) use.key[3] = *std::max_element(use.key.begin(), use.key.begin() + 3);
      std::sort(use.key.begin(), use.key.end());
      uses.push_back(use);
    }
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t next = i + 1;
    while (next < uses.size() && uses[next].key == uses[i].key) ++next;
    if (next == i + 1) visit(uses[i].cell, cell_faces(cells[uses[i].cell].kind)[uses[i].face]);
    i = next;
  }
}

}  // namespace scree::mesh
