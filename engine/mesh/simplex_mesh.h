// The mesh of one shape, before it is copied and broken into blocks.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/mesh/raw_mesh.h"

namespace scree::mesh {

// A face on the outside of a mesh, by its nodes in ascending order.
template <int dim>
using OuterFace = std::array<std::size_t, dim>;

template <int dim>
struct NamedFace {
  OuterFace<dim> nodes;
  std::size_t surface = 0;  // whose name it is, of Parts::surfaces
};

template <int dim>
struct SimplexMesh {
  std::vector<Point<dim>> nodes;                           // [m]
  std::vector<std::array<std::size_t, dim + 1>> elements;  // positively oriented
  std::vector<RawLargeCell> cells;  // if there are any: the elements are their splits by the smallest node, in this order
  std::vector<NamedFace<dim>> named;
};

// One connected mesh or, from a file, several that share no node.
template <int dim>
struct Parts {
  std::vector<SimplexMesh<dim>> meshes;
  std::vector<std::string> surfaces;  // the names of their surfaces
};

// The cells that are elements in this dimension.
template <int dim>
const std::vector<RawCell<dim + 1>>& element_cells(const RawMesh& raw);

// Area or volume of a simplex, negative if its corners run the wrong way round.
template <int dim>
double signed_volume(const std::array<Point<dim>, dim + 1>& corners);

// A simplex of no more than this is flat: 1e-10 of the cube (2-D: the square) of its longest edge.
template <int dim>
double flat_volume(const std::array<Point<dim>, dim + 1>& corners);

// The lowest mean ratio of an element: 1 if all are regular, 0 if one is flat (Liu & Joe 1994).
template <int dim>
double worst_quality(const SimplexMesh<dim>& mesh);

// The faces that belong to one element only, ascending; of the quadrilateral faces of cells, both diagonals' triangles.
template <int dim>
std::vector<OuterFace<dim>> outer_faces(const SimplexMesh<dim>& mesh);

// A mesh of each set of elements of `raw` and the nodes they use, both in the order of `raw`, with the faces on its surfaces.
// The sets have no node in common and all elements between them.
template <int dim>
std::vector<SimplexMesh<dim>> parts_of(const RawMesh& raw, const std::vector<std::vector<std::size_t>>& sets);

// All elements of `raw`.
template <int dim>
SimplexMesh<dim> whole_of(const RawMesh& raw);

}  // namespace scree::mesh
