#include "engine/mesh/block_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/chunks.h"
#include "engine/mesh/lone_faces.h"

namespace scree::mesh {

namespace {

template <int dim>
std::array<NodeId, dim> opposite_face(const std::array<NodeId, dim + 1>& element, int corner) {
  std::array<NodeId, dim> nodes;
  for (int i = 0; i < dim; ++i) nodes[i] = element[opposite_corners<dim>[corner][i]];
  return nodes;
}

}  // namespace

template <int dim>
void add_boundary_faces(const BlockMesh<dim>& mesh, BlockId id, Table<FaceId, Face<dim>>& faces) {
  const Block& block = mesh.blocks[id];
  const auto add = [&](ElementId element, int corner) {
    faces.push_back({opposite_face<dim>(mesh.elements[element], corner), element, id});
  };
  if (block.elements.size() == 1) {
    for (int corner = 0; corner <= dim; ++corner) add(block.elements[0], corner);
    return;
  }
  const auto nodes_of = [&](std::size_t i) {
    const auto& nodes = mesh.elements[block.elements[i]];
    std::array<std::uint32_t, dim + 1> own;
    for (int corner = 0; corner <= dim; ++corner) {
      own[corner] = static_cast<std::uint32_t>(nodes[corner].index() - block.nodes.first());
    }
    return own;
  };
  for (const std::uint32_t place : lone_simplex_faces<dim>(block.nodes.size(), block.elements.size(), nodes_of)) {
    add(block.elements[place / (dim + 1)], static_cast<int>(place % (dim + 1)));
  }
}

template <int dim>
Table<FaceId, Face<dim>> boundary_faces(const BlockMesh<dim>& mesh) {
  std::vector<std::size_t> ends{0};
  for (const Block& block : mesh.blocks) ends.push_back(ends.back() + block.elements.size());
  const std::vector<Chunk> chunks = chunks_by_size(ends, chunk_size);
  std::vector<Table<FaceId, Face<dim>>> parts(chunks.size());
  for_chunks(chunks, [&](Chunk chunk) {
    for (std::size_t b = chunk.begin; b < chunk.end; ++b) add_boundary_faces(mesh, BlockId{b}, parts[chunk.number]);
  });
  std::vector<Face<dim>> faces;
  std::size_t count = 0;
  for (const auto& part : parts) count += part.size();
  faces.reserve(count);
  for (const auto& part : parts) faces.insert(faces.end(), part.begin(), part.end());
  return Table<FaceId, Face<dim>>(std::move(faces));
}

template <int dim>
double element_volume(const BlockMesh<dim>& mesh, ElementId element) {
  return simplex_volume<dim>(mesh, mesh.elements[element]);
}

template <int dim>
double simplex_volume(const BlockMesh<dim>& mesh, const std::array<NodeId, dim + 1>& corner) {
  Eigen::Matrix<double, dim, dim> edges;
  for (int i = 0; i < dim; ++i) edges.col(i) = mesh.nodes[corner[i + 1]] - mesh.nodes[corner[0]];
  return edges.determinant() / (dim == 2 ? 2.0 : 6.0);
}

template <int dim>
Point<dim> area_vector(const BlockMesh<dim>& mesh, const std::array<NodeId, dim>& nodes) {
  const Point<dim> way = mesh.nodes[nodes[1]] - mesh.nodes[nodes[0]];
  if constexpr (dim == 2) {
    return {way.y(), -way.x()};
  } else {
    return 0.5 * way.cross(mesh.nodes[nodes[2]] - mesh.nodes[nodes[0]]);
  }
}

template <int dim>
double face_area(const BlockMesh<dim>& mesh, const Face<dim>& face) {
  return area_vector<dim>(mesh, face.nodes).norm();
}

template <int dim>
double element_mean_edge(const BlockMesh<dim>& mesh, ElementId element) {
  const auto& corner = mesh.elements[element];
  double sum = 0;
  for (int i = 0; i <= dim; ++i) {
    for (int j = 0; j < i; ++j) sum += (mesh.nodes[corner[i]] - mesh.nodes[corner[j]]).norm();
  }
  constexpr int edges = dim * (dim + 1) / 2;
  return sum / edges;
}

template <int dim>
double mean_edge(const BlockMesh<dim>& mesh) {
  double sum[2] = {0, 0};  // of fixed blocks, of free ones
  std::size_t count[2] = {0, 0};
  for (const Block& block : mesh.blocks) {
    const int free = mesh.bodies[block.body].fixed ? 0 : 1;
    for (const ElementId e : block.elements) sum[free] += element_mean_edge(mesh, e);
    count[free] += block.elements.size();
  }
  const int which = count[1] > 0 ? 1 : 0;
  return count[which] > 0 ? sum[which] / static_cast<double>(count[which]) : 0.0;
}

template <int dim>
Table<ElementId, BlockId> element_blocks(const BlockMesh<dim>& mesh) {
  Table<ElementId, BlockId> owner(mesh.elements.size());
  for (const BlockId block : mesh.blocks.ids()) {
    for (const ElementId e : mesh.blocks[block].elements) owner[e] = block;
  }
  return owner;
}

#define SCREE_INSTANTIATE(dim)                                                                      \
  template Table<FaceId, Face<dim>> boundary_faces<dim>(const BlockMesh<dim>&);                     \
  template void add_boundary_faces<dim>(const BlockMesh<dim>&, BlockId, Table<FaceId, Face<dim>>&); \
  template double element_volume<dim>(const BlockMesh<dim>&, ElementId);                            \
  template double simplex_volume<dim>(const BlockMesh<dim>&, const std::array<NodeId, dim + 1>&);   \
  template Point<dim> area_vector<dim>(const BlockMesh<dim>&, const std::array<NodeId, dim>&);      \
  template double face_area<dim>(const BlockMesh<dim>&, const Face<dim>&);                          \
  template double element_mean_edge<dim>(const BlockMesh<dim>&, ElementId);                         \
  template double mean_edge<dim>(const BlockMesh<dim>&);                                            \
  template Table<ElementId, BlockId> element_blocks<dim>(const BlockMesh<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::mesh
