// The kinds of cells that are more than a simplex: their corners in the order of VTK (and Gmsh), their faces and their splits.
//
// A quadrilateral runs counter-clockwise. A wedge has its corners 3, 4, 5 above 0, 1, 2, a hexahedron 4 to 7 above 0 to 3; seen
// from above, both run counter-clockwise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <boost/container/static_vector.hpp>

namespace scree::mesh {

enum class CellKind { quadrilateral, wedge, hexahedron };

using CornerList = std::span<const std::size_t>;

// Of one cell: at most the ten of a hexahedron's two splits.
template <class Simplex>
using SimplexList = boost::container::static_vector<Simplex, 10>;

// How many corners a cell has: the entries of its nodes that count.
constexpr std::size_t corner_count(CellKind kind) {
  if (kind == CellKind::hexahedron) return 8;
  return kind == CellKind::wedge ? 6 : 4;
}

const char* kind_name(CellKind kind);

// The faces by their corners, ordered so that the normal points outwards: edges of a quadrilateral, else triangles and
// quadrilaterals.
std::span<const CornerList> cell_faces(CellKind kind);

// The simplices of the two overlapping splits of Li and Feng's mixed discretisation, positively oriented, those of the first
// split first; `dim` + 1 corners each. Each of the two fills the cell, and on every quadrilateral face the one has one
// diagonal, the other the other, so that their mean prefers none and fits the neighbour's.
std::span<const CornerList> mixed_simplices(CellKind kind);

// How many simplices the split by the smallest node makes: 2, 3 and 6.
std::size_t split_count(CellKind kind);

// The conforming split: the cell seen from its smallest node, with each face cut from its own smallest node. Neighbours have
// the same smallest node on the face they share, and so cut it alike (Dompierre et al., "How to subdivide pyramids, prisms and
// hexahedra into tetrahedra", 1999; by their rule a hexahedron has 5 or 6, by this one always 6). Positively oriented.
template <int dim, class Node>
SimplexList<std::array<Node, dim + 1>> split_by_smallest(CellKind kind, const std::array<Node, 8>& nodes) {
  SimplexList<std::array<Node, dim + 1>> simplices;
  const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(corner_count(kind));
  const Node apex = *std::min_element(nodes.begin(), end);
  const auto add = [&](auto... outward) {
    if (((outward == apex) || ...)) return;
    simplices.push_back({apex, outward...});
  };
  for (const CornerList& face : cell_faces(kind)) {
    if constexpr (dim == 2) {
      add(nodes[face[0]], nodes[face[1]]);
    } else if (face.size() == 3) {
      add(nodes[face[0]], nodes[face[1]], nodes[face[2]]);
    } else {
      std::size_t first = 0;
      for (std::size_t i = 1; i < 4; ++i) first = nodes[face[i]] < nodes[face[first]] ? i : first;
      const auto at = [&](std::size_t i) { return nodes[face[(first + i) % 4]]; };
      add(at(0), at(1), at(2));
      add(at(0), at(2), at(3));
    }
  }
  return simplices;
}

}  // namespace scree::mesh
