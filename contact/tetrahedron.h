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

// Of a set of vertices the edges between two of them, one bit each.
inline constexpr std::array<unsigned, 16> edges_among = [] {
  std::array<unsigned, 16> edges{};
  for (unsigned vertices = 0; vertices < 16; ++vertices) {
    for (unsigned e = 0; e < 6; ++e) {
      edges[vertices] |= (vertices >> element_edges[e].start & vertices >> element_edges[e].end & 1u) << e;
    }
  }
  return edges;
}();

// Of a set of vertices the edges that end in one of them, one bit each.
inline constexpr std::array<unsigned, 16> edges_at = [] {
  std::array<unsigned, 16> edges{};
  for (unsigned vertices = 0; vertices < 16; ++vertices) edges[vertices] = 63u & ~edges_among[15u & ~vertices];
  return edges;
}();

// Is the cross product of the outward normals of an edge's faces, that beside its first vertex aside with the second's, along
// the edge (in a positively oriented tetrahedron)? Or against it.
constexpr bool turns_along(const ElementEdge& edge) {
  const std::array<int, 4> order{edge.start, edge.end, edge.beside[0], edge.beside[1]};
  bool even = true;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) even ^= order[j] > order[i];
  }
  return even;
}

// Edges that stand out along a direction perpendicular to them and to another edge: the cross product of both, own edge first,
// or its opposite.
struct EdgeSenses {
  std::uint8_t along = 0;  // one bit each
  std::uint8_t against = 0;
};

// Of the faces whose normals may lean along the other edge, and of those that may lean against it, by their bits. The normals
// of an edge's faces n, m and the other edge b give n (m . b) - m (n . b) = b x (n x m): with n . b < 0 < m . b that is a
// direction between the two, in which the edge stands out, and n x m lies along the edge or against it.
inline constexpr std::array<std::array<EdgeSenses, 16>, 16> edges_leaning = [] {
  std::array<std::array<EdgeSenses, 16>, 16> leaning{};
  for (unsigned along = 0; along < 16; ++along) {
    for (unsigned against = 0; against < 16; ++against) {
      for (unsigned e = 0; e < 6; ++e) {
        const auto& [n, m] = element_edges[e].beside;
        const unsigned rising = along >> m & against >> n & 1u, falling = along >> n & against >> m & 1u;
        auto& [to, back] = leaning[along][against];
        const bool turned = turns_along(element_edges[e]);
        to = static_cast<std::uint8_t>(to | (turned ? falling : rising) << e);
        back = static_cast<std::uint8_t>(back | (turned ? rising : falling) << e);
      }
    }
  }
  return leaning;
}();

}  // namespace scree::contact
