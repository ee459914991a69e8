#include "engine/mesh/block_mesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

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

// A face of an element, by its nodes in ascending order, and its place among all faces of its block.
template <int dim>
struct FaceUse {
  std::array<NodeId, dim> key;
  std::uint32_t place;

  friend auto operator<=>(const FaceUse&, const FaceUse&) = default;
};

// Sorting a block's faces by their nodes puts the two uses of an inner face side by side; what stands alone is boundary.
template <int dim>
void add_block_faces(const BlockMesh<dim>& mesh, BlockId block, std::vector<FaceUse<dim>>& uses,
                     Table<FaceId, Face<dim>>& faces) {
  const auto elements = mesh.blocks[block].elements;
  uses.clear();
  for (std::size_t place = 0; place < elements.size() * (dim + 1); ++place) {
    auto nodes = opposite_face<dim>(mesh.elements[elements[place / (dim + 1)]], static_cast<int>(place % (dim + 1)));
    std::sort(nodes.begin(), nodes.end());
    uses.push_back({nodes, static_cast<std::uint32_t>(place)});
  }
  std::sort(uses.begin(), uses.end());
  std::vector<std::uint32_t> boundary;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t next = i + 1;
    while (next < uses.size() && uses[next].key == uses[i].key) ++next;
    if (next == i + 1) boundary.push_back(uses[i].place);
    i = next;
  }
  std::sort(boundary.begin(), boundary.end());
  for (const std::uint32_t place : boundary) {
    const ElementId element = elements[place / (dim + 1)];
    faces.push_back({opposite_face<dim>(mesh.elements[element], static_cast<int>(place % (dim + 1))), element, block});
  }
}

}  // namespace

template <int dim>
Table<FaceId, Face<dim>> boundary_faces(const BlockMesh<dim>& mesh) {
  Table<FaceId, Face<dim>> faces;
  std::vector<FaceUse<dim>> uses;
  for (const BlockId block : mesh.blocks.ids()) add_block_faces(mesh, block, uses, faces);
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

#define SCREE_INSTANTIATE(dim)                                                                    \
  template Table<FaceId, Face<dim>> boundary_faces<dim>(const BlockMesh<dim>&);                   \
  template double element_volume<dim>(const BlockMesh<dim>&, ElementId);                          \
  template double simplex_volume<dim>(const BlockMesh<dim>&, const std::array<NodeId, dim + 1>&); \
  template double face_area<dim>(const BlockMesh<dim>&, const Face<dim>&);                        \
  template double element_mean_edge<dim>(const BlockMesh<dim>&, ElementId);                       \
  template double mean_edge<dim>(const BlockMesh<dim>&);                                          \
  template Table<ElementId, BlockId> element_blocks<dim>(const BlockMesh<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::mesh
