// The convex polyhedra a block is made of: what collides, and what overlaps are measured on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

// A convex polyhedron. Triangles in one plane are one face, so a meshed box has 8 vertices, 6 faces and 12 edges; also if its
// corners are rounded, as those of a mesh file are (engine/rigid/README.md).
struct ConvexPiece {
  struct Face {
    Eigen::Vector3d normal;             // outwards, unit
    std::vector<std::int32_t> corners;  // counter-clockwise seen from outside
    bool inner = false;                 // between this piece and another of its block
    bool bent = false;                  // another face of the piece lies nearly in its plane
  };
  struct Edge {
    std::array<std::int32_t, 2> corners;
    std::array<std::int32_t, 2> faces;
    // Of a block of several pieces: whether its surface has no edge here that stands out, and if it has, the normals of the two
    // faces of that surface beside it.
    bool inner = false;
    std::array<Eigen::Vector3d, 2> beside{};
  };
  std::vector<Eigen::Vector3d> vertices;  // [m], where the mesh has them
  std::vector<std::int32_t> nodes;  // of a block of several pieces: of each vertex the node, counted from the block's first
  std::vector<Face> faces;
  std::vector<Edge> edges;
};

// One piece if the block is convex, otherwise one tetrahedron per element. A block counts as convex if its boundary is one
// closed surface on which no edge is indented by more than a thousandth of the edges beside it, nor any point above a triangle
// by more than that of the longest: a meshed sphere may have such dents where the mesher chose the other diagonal of four
// nearly concyclic points.
std::vector<ConvexPiece> convex_pieces(const BlockMesh<3>& mesh, BlockId block);

// Of each node of a block the directions in which the edges of the block's surface leave it; none inside.
std::vector<std::vector<Eigen::Vector3d>> surface_edges(const BlockMesh<3>& mesh, BlockId block);

}  // namespace scree::mesh
