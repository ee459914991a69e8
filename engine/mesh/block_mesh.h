// All blocks of a scene as one simplex mesh: triangles in 2-D, tetrahedra in 3-D.
//
// No node is shared between blocks, and the nodes and elements of a block are consecutive, so that a block is
// a pair of ranges. Elements are positively oriented. 2-D has unit thickness.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/base/ids.h"
#include "engine/mesh/cell_kind.h"

namespace scree::mesh {

// What a scene names: the source of one or many blocks.
struct Body {
  std::string name;
  MaterialId material;
  bool fixed = false;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // at the start [m/s]
  std::string made_from = {};                          // in words (made_from.h); empty: not known
};

// One independent continuum.
struct Block {
  BodyId body;
  IdRange<NodeId> nodes;
  IdRange<ElementId> elements;
  IdRange<CellId> cells = {};  // empty if the block has simplices only; else its elements are a conforming split of them
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // how it has turned from its body's shape
};

// A quadrilateral, wedge or hexahedron.
struct Cell {
  CellKind kind = CellKind::hexahedron;
  std::array<NodeId, 8> nodes;  // those beyond its corners are not valid
};

// A part of a body's boundary that has a name: a side of a box, a physical group of a mesh file.
struct NamedSurface {
  BodyId body;
  std::string name;
};

// A face of a block that lies on a named surface; inner faces of a body that is broken into blocks lie on none.
template <int dim>
struct SurfaceFace {
  std::array<NodeId, dim> nodes;  // ascending
  SurfaceId surface;

  friend auto operator<=>(const SurfaceFace&, const SurfaceFace&) = default;
};

template <int dim>
struct BlockMesh {
  static constexpr int corners = dim + 1;
  using Element = std::array<NodeId, corners>;

  Table<NodeId, Point<dim>> nodes;  // [m]
  Table<ElementId, Element> elements;
  Table<CellId, Cell> cells;
  Table<BlockId, Block> blocks;
  Table<BodyId, Body> bodies;
  Table<SurfaceId, NamedSurface> surface_names;
  std::vector<SurfaceFace<dim>> surfaces;  // ascending
};

// A boundary face of a block: an edge in 2-D, a triangle in 3-D, ordered so that its normal points outwards.
template <int dim>
struct Face {
  std::array<NodeId, dim> nodes;
  ElementId element;  // the element that owns it
  BlockId block;
};

// Of each corner of an element the corners of the face opposite to it, ordered so that its normal points out of a positive
// element.
template <int dim>
inline constexpr std::array<std::array<int, dim>, dim + 1> opposite_corners;
template <>
inline constexpr std::array<std::array<int, 2>, 3> opposite_corners<2> = {{{1, 2}, {2, 0}, {0, 1}}};
template <>
inline constexpr std::array<std::array<int, 3>, 4> opposite_corners<3> = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

// Every face that belongs to one element only, ordered by block, element and opposite corner.
template <int dim>
Table<FaceId, Face<dim>> boundary_faces(const BlockMesh<dim>& mesh);

// Adds those of one block.
template <int dim>
void add_boundary_faces(const BlockMesh<dim>& mesh, BlockId block, Table<FaceId, Face<dim>>& faces);

// Signed area (2-D, times unit thickness) or volume (3-D) of an element; positive for a well-oriented one.
template <int dim>
double element_volume(const BlockMesh<dim>& mesh, ElementId element);
template <int dim>
double simplex_volume(const BlockMesh<dim>& mesh, const std::array<NodeId, dim + 1>& corners);

// Outward normal of a face of a block, its nodes in their order there, as long as the face's area [m2].
template <int dim>
Point<dim> area_vector(const BlockMesh<dim>& mesh, const std::array<NodeId, dim>& nodes);

// Length (2-D, times unit thickness) or area (3-D) of a face [m2].
template <int dim>
double face_area(const BlockMesh<dim>& mesh, const Face<dim>& face);

// Mean length of an element's edges: the characteristic length of eq. (11) [m].
template <int dim>
double element_mean_edge(const BlockMesh<dim>& mesh, ElementId element);

// Mean length of all edges of all elements of the free blocks, or of all blocks if none is free [m].
template <int dim>
double mean_edge(const BlockMesh<dim>& mesh);

// Block of each element.
template <int dim>
Table<ElementId, BlockId> element_blocks(const BlockMesh<dim>& mesh);

}  // namespace scree::mesh
