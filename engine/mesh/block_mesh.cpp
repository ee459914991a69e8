#include "engine/mesh/block_mesh.h"

#include <algorithm>
#include <cstdint>

#include "engine/mesh/lone_faces.h"

namespace scree::mesh {

namespace {

// The corners of the face opposite to `corner`, ordered so that the normal points out of a positive element.
template <int dim>
std::array<NodeId, dim> opposite_face(const std::array<NodeId, dim + 1>& element, int corner) {
  if constexpr (dim == 2) {
    return {element[(corner + 1) % 3], element[(corner + 2) % 3]};
  } else {
    static constexpr int order[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    return {element[order[corner][0]], element[order[corner][1]], element[order[corner][2]]};
  }
}

}  // namespace

template <int dim>
void add_boundary_faces(const BlockMesh<dim>& mesh, BlockId id, Table<FaceId, Face<dim>>& faces) {
  const Block& block = mesh.blocks[id];
  const auto for_each_face = [&](const auto& visit) {
    for (const ElementId element : block.elements) {
      for (int corner = 0; corner <= dim; ++corner) {
        const auto nodes = opposite_face<dim>(mesh.elements[element], corner);
        std::array<std::uint32_t, dim> face;
        std::transform(nodes.begin(), nodes.end(), face.begin(),
                       [&](NodeId node) { return static_cast<std::uint32_t>(node.index() - block.nodes.first()); });
        std::sort(face.begin(), face.end());
        visit(face);
      }
    }
  };
  for (const std::uint32_t place : lone_faces<dim>(block.nodes.size(), for_each_face)) {
    const ElementId element = block.elements[place / (dim + 1)];
    faces.push_back({opposite_face<dim>(mesh.elements[element], static_cast<int>(place % (dim + 1))), element, id});
  }
}

template <int dim>
Table<FaceId, Face<dim>> boundary_faces(const BlockMesh<dim>& mesh) {
  Table<FaceId, Face<dim>> faces;
  for (const BlockId block : mesh.blocks.ids()) add_boundary_faces(mesh, block, faces);
  return faces;
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
double face_area(const BlockMesh<dim>& mesh, const Face<dim>& face) {
  const Point<dim> u = mesh.nodes[face.nodes[1]] - mesh.nodes[face.nodes[0]];
  if constexpr (dim == 2) {
    return u.norm();
  } else {
    return 0.5 * u.cross(mesh.nodes[face.nodes[2]] - mesh.nodes[face.nodes[0]]).norm();
  }
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
  template double face_area<dim>(const BlockMesh<dim>&, const Face<dim>&);                          \
  template double element_mean_edge<dim>(const BlockMesh<dim>&, ElementId);                         \
  template double mean_edge<dim>(const BlockMesh<dim>&);                                            \
  template Table<ElementId, BlockId> element_blocks<dim>(const BlockMesh<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::mesh
