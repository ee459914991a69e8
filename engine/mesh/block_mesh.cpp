#include "engine/mesh/block_mesh.h"

#include <algorithm>
#include <map>

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

template <int dim>
void add_block_faces(const BlockMesh<dim>& mesh, BlockId block, Table<FaceId, Face<dim>>& faces) {
  std::map<std::array<NodeId, dim>, int> uses;
  const auto key = [](std::array<NodeId, dim> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  for (const ElementId e : mesh.blocks[block].elements) {
    for (int corner = 0; corner <= dim; ++corner) ++uses[key(opposite_face<dim>(mesh.elements[e], corner))];
  }
  for (const ElementId e : mesh.blocks[block].elements) {
    for (int corner = 0; corner <= dim; ++corner) {
      const auto nodes = opposite_face<dim>(mesh.elements[e], corner);
      if (uses[key(nodes)] == 1) faces.push_back({nodes, e, block});
    }
  }
}

}  // namespace

template <int dim>
Table<FaceId, Face<dim>> boundary_faces(const BlockMesh<dim>& mesh) {
  Table<FaceId, Face<dim>> faces;
  for (const BlockId block : mesh.blocks.ids()) add_block_faces(mesh, block, faces);
  return faces;
}

template <int dim>
double element_volume(const BlockMesh<dim>& mesh, ElementId element) {
  const auto& corner = mesh.elements[element];
  Eigen::Matrix<double, dim, dim> edges;
  for (int i = 0; i < dim; ++i) edges.col(i) = mesh.nodes[corner[i + 1]] - mesh.nodes[corner[0]];
  return edges.determinant() / (dim == 2 ? 2.0 : 6.0);
}

template <int dim>
double element_mean_edge(const BlockMesh<dim>& mesh, ElementId element) {
  const auto& corner = mesh.elements[element];
  double sum = 0;
  for (int i = 0; i <= dim; ++i) {
    for (int j = 0; j < i; ++j) sum += (mesh.nodes[corner[i]] - mesh.nodes[corner[j]]).norm();
  }
  return sum / (dim * (dim + 1) / 2);
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

#define SCREE_INSTANTIATE(dim)                                                     \
  template Table<FaceId, Face<dim>> boundary_faces<dim>(const BlockMesh<dim>&);    \
  template double element_volume<dim>(const BlockMesh<dim>&, ElementId);           \
  template double element_mean_edge<dim>(const BlockMesh<dim>&, ElementId);        \
  template double mean_edge<dim>(const BlockMesh<dim>&);                           \
  template Table<ElementId, BlockId> element_blocks<dim>(const BlockMesh<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::mesh
