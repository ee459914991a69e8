// The convex polyhedra a block is made of: what collides, and what overlaps are measured on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// A convex polyhedron. Triangles in one plane are one face, so a meshed box has 8 vertices, 6 faces and 12 edges.
struct ConvexPiece {
  struct Face {
    Eigen::Vector3d normal;             // outwards, unit
    std::vector<std::int32_t> corners;  // counter-clockwise seen from outside
  };
  struct Edge {
    std::array<std::int32_t, 2> corners;
    std::array<std::int32_t, 2> faces;
  };
  std::vector<Eigen::Vector3d> vertices;  // [m], where the mesh has them
  std::vector<Face> faces;
  std::vector<Edge> edges;
};

// One piece if the block is convex, otherwise one tetrahedron per element. A block counts as convex if its boundary is one
// closed surface on which no edge is indented by more than a thousandth of the edges beside it: a meshed sphere may have
// such dents where the mesher chose the other diagonal of four nearly concyclic points.
std::vector<ConvexPiece> convex_pieces(const BlockMesh<3>& mesh, BlockId block);

}  // namespace scree::mesh
