// The edges of a tetrahedron, and where they are in its faces.
#pragma once

#include <array>
#include <cstdint>

#include "engine/mesh/block_mesh.h"

namespace scree::contact {

// An edge, as vertices, and the two vertices beside it: the faces opposite to these meet in it.
struct ElementEdge {
  int start, end;
  std::array<int, 2> beside;
};
inline constexpr std::array<ElementEdge, 6> element_edges = {
    {{0, 1, {2, 3}}, {0, 2, {1, 3}}, {0, 3, {1, 2}}, {1, 2, {0, 3}}, {1, 3, {0, 2}}, {2, 3, {0, 1}}}};

// Which side of the face opposite to vertex `face` an edge is: side i joins the face's corners i and i + 1.
constexpr int side_of(const ElementEdge& edge, int face) {
  const auto& corners = mesh::opposite_corners<3>[face];
  for (int side = 0; side < 3; ++side) {
    const int from = corners[side], to = corners[(side + 1) % 3];
    if ((from == edge.start && to == edge.end) || (from == edge.end && to == edge.start)) return side;
  }
  return -1;
}

// Of a set of faces the edges of any of them, one bit each. Face i is opposite to vertex i.
inline constexpr std::array<std::uint8_t, 16> edges_of_faces = [] {
  std::array<std::uint8_t, 16> edges{};
  for (unsigned faces = 0; faces < 16; ++faces) {
    for (unsigned e = 0; e < 6; ++e) {
      const auto& [left, right] = element_edges[e].beside;
      const bool any = ((faces >> left | faces >> right) & 1u) != 0;
      edges[faces] = static_cast<std::uint8_t>(edges[faces] | (any ? 1u : 0u) << e);
    }
  }
  return edges;
}();

// The edges that have one of their faces in a first set and the other in a second, one bit each.
inline constexpr std::array<std::array<std::uint8_t, 16>, 16> edges_between = [] {
  std::array<std::array<std::uint8_t, 16>, 16> between{};
  for (unsigned first = 0; first < 16; ++first) {
    for (unsigned second = 0; second < 16; ++second) {
      for (unsigned e = 0; e < 6; ++e) {
        const auto& [left, right] = element_edges[e].beside;
        const bool either = (((first >> left & second >> right) | (first >> right & second >> left)) & 1u) != 0;
        auto& edges = between[first][second];
        edges = static_cast<std::uint8_t>(edges | (either ? 1u : 0u) << e);
      }
    }
  }
  return between;
}();

}  // namespace scree::contact
