#include "engine/mesh/block_mesh.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
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

// A face of an element among those with the same least node: its other nodes in ascending order, and its place among all faces
// of its block.
template <int dim>
struct FaceUse {
  std::array<NodeId, dim - 1> key;
  std::uint32_t place;

  friend auto operator<=>(const FaceUse&, const FaceUse&) = default;
};

// The faces of a block by their least node: a list to go through in linear time, whatever the block's size.
template <int dim>
class FacesByNode {
 public:
  FacesByNode(const BlockMesh<dim>& mesh, const Block& block)
      : first_(block.nodes.size() == 0 ? 0 : (*block.nodes.begin()).index()), begin_(block.nodes.size() + 1) {
    const std::size_t places = block.elements.size() * (dim + 1);
    for (std::size_t place = 0; place < places; ++place) ++begin_[least(sorted_face(mesh, block, place)) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    uses_.resize(places);
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t place = 0; place < places; ++place) {
      const auto nodes = sorted_face(mesh, block, place);
      FaceUse<dim>& use = uses_[next[least(nodes)]++];
      std::copy(nodes.begin() + 1, nodes.end(), use.key.begin());
      use.place = static_cast<std::uint32_t>(place);
    }
  }

  // The places of the faces that stand alone, ascending.
  std::vector<std::uint32_t> boundary() {
    std::vector<std::uint32_t> alone;
    for (std::size_t node = 0; node + 1 < begin_.size(); ++node) {
      const auto begin = uses_.begin() + begin_[node];
      const auto end = uses_.begin() + begin_[node + 1];
      std::sort(begin, end);
      for (auto use = begin; use != end;) {
        const auto next = std::find_if(use, end, [&](const FaceUse<dim>& other) { return other.key != use->key; });
        if (next == use + 1) alone.push_back(use->place);
        use = next;
      }
    }
    std::sort(alone.begin(), alone.end());
    return alone;
  }

 private:
  static std::array<NodeId, dim> sorted_face(const BlockMesh<dim>& mesh, const Block& block, std::size_t place) {
    auto nodes = opposite_face<dim>(mesh.elements[block.elements[place / (dim + 1)]], static_cast<int>(place % (dim + 1)));
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }
  std::size_t least(const std::array<NodeId, dim>& nodes) const { return nodes.front().index() - first_; }

  std::size_t first_;                 // node of the block
  std::vector<std::uint32_t> begin_;  // of each node in uses_, and the end
  std::vector<FaceUse<dim>> uses_;
};

// The two uses of an inner face have the same nodes; what stands alone is boundary.
template <int dim>
void add_block_faces(const BlockMesh<dim>& mesh, BlockId block, Table<FaceId, Face<dim>>& faces) {
  const auto elements = mesh.blocks[block].elements;
  for (const std::uint32_t place : FacesByNode<dim>(mesh, mesh.blocks[block]).boundary()) {
    const ElementId element = elements[place / (dim + 1)];
    faces.push_back({opposite_face<dim>(mesh.elements[element], static_cast<int>(place % (dim + 1))), element, block});
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
