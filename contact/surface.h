// The boundary of all blocks, with what the search asks of it again and again.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "contact/block_elements.h"
#include "contact/face_point.h"
#include "engine/base/written_later.h"
#include "engine/mesh/block_mesh.h"

namespace scree::contact {

using EdgeId = Id<struct EdgeTag>;

// An edge of a block's boundary in 3-D and the two faces that meet in it.
struct SurfaceEdge {
  std::array<NodeId, 2> nodes;  // ascending
  std::array<FaceId, 2> faces;  // ascending
};

// Tables of what is found for every face or edge, each entry by one thread.
template <class IdType, class Item>
using FoundTable = Table<IdType, Item, VectorWrittenLater<Item>>;

template <int dim>
struct Surface {
  const mesh::BlockMesh<dim>& mesh;  // of the caller, who keeps it
  double rounding;                   // of a difference of two coordinates [m]
  Table<FaceId, mesh::Face<dim>> faces;
  FoundTable<FaceId, Point<dim>> normals;  // unit, outwards
  FoundTable<FaceId, double> areas;        // [m2] (2-D: length times unit thickness)
  FoundTable<FaceId, double> lengths;      // characteristic length of the face's element, eq. (11) [m]
  std::shared_ptr<const BlockElements<dim>> blocks;
  // The rims, if they have been added: what is asked where a point is closest to a node or an edge.
  // Of the blocks of several elements, the mean of the faces around, weighted by their angle there; any length. It is asked too
  // rarely for the others.
  Table<NodeId, Point<dim>> node_normals;
  // 3-D only. Edge i of a face joins its corners i and i + 1.
  FoundTable<EdgeId, SurfaceEdge> edges;
  FoundTable<FaceId, std::array<EdgeId, 3>> face_edges;
};

// Has the block no element but one?
template <int dim>
bool is_whole(const mesh::BlockMesh<dim>& mesh, BlockId block) {
  return mesh.blocks[block].elements.size() == 1;
}

// Of some of the boundary faces, in the order of their blocks and elements, without the rims.
template <int dim>
Surface<dim> surface_of(const mesh::BlockMesh<dim>& mesh, Table<FaceId, mesh::Face<dim>> faces);

template <int dim>
void add_rims(Surface<dim>& surface);

// Of them all, with the rims.
template <int dim>
Surface<dim> make_surface(const mesh::BlockMesh<dim>& mesh) {
  Surface<dim> surface = surface_of(mesh, mesh::boundary_faces(mesh));
  add_rims(surface);
  return surface;
}

// Of each block its first face, and the number of faces behind them. Faces come in the order of their blocks.
template <int dim>
std::vector<std::size_t> block_starts(const mesh::BlockMesh<dim>& mesh, const Table<FaceId, mesh::Face<dim>>& faces);

template <int dim>
Corners<dim> corners_of(const Surface<dim>& surface, FaceId face) {
  Corners<dim> corners;
  for (int i = 0; i < dim; ++i) corners[i] = surface.mesh.nodes[surface.faces[face].nodes[i]];
  return corners;
}

// Which vertex of its element a face is opposite to. Without a branch, which no one could foretell.
template <int dim>
int opposite_vertex(const Surface<dim>& surface, FaceId face) {
  const auto& element = surface.mesh.elements[surface.faces[face].element];
  auto missing = element[0].value();
  for (int v = 1; v <= dim; ++v) missing ^= element[v].value();
  for (const NodeId node : surface.faces[face].nodes) missing ^= node.value();
  int vertex = 0;
  for (int v = 1; v <= dim; ++v) vertex |= element[v].value() == missing ? v : 0;
  return vertex;
}

// A face, which vertex of its element it is opposite to, and whether its block has no other element.
struct PlacedFace {
  FaceId face;
  int plane;
  bool whole;
};

// How far an offset from a point of a face's rim, given by its weights, leads out of the block, times any positive number: on
// an edge along the mean of both faces' normals, at a node along the angle-weighted mean. With these the sign says whether it
// leads out if that is the closest point of the block (Baerentzen and Aanaes, IEEE TVCG 11(3), 2005).
template <int dim>
double rise_at_rim(const Surface<dim>& surface, const PlacedFace& at, const std::array<double, dim>& weights,
                   const Point<dim>& offset);

}  // namespace scree::contact
