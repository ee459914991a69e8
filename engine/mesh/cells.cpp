#include "engine/mesh/cells.h"

#include <algorithm>

#include "engine/mesh/outer_cell_faces.h"

namespace scree::mesh {

namespace {

void add_cell_block(const BlockMesh<3>& mesh, BlockId block, Table<FaceId, WeightedFace<3>>& faces) {
  const auto range = mesh.blocks[block].cells;
  const std::span cells(mesh.cells.raw().data() + range.first(), range.size());
  const auto index = [first = mesh.blocks[block].nodes.first()](NodeId node) { return node.index() - first; };
  for_each_outer_face(cells, mesh.blocks[block].nodes.size(), index, [&](std::size_t c, CornerList corners) {
    const auto& nodes = cells[c].nodes;
    const double weight = corners.size() == 3 ? 1.0 : 0.5;
    for (const auto& [i, j, k] : face_triangles(corners.size())) {
      faces.push_back({{{nodes[corners[i]], nodes[corners[j]], nodes[corners[k]]}, ElementId{}, block}, weight});
    }
  });
}

// In 3-D every edge is in two faces, in 2-D it is one.
template <int dim>
double cell_mean_edge(const BlockMesh<dim>& mesh, const Cell& cell) {
  double sum = 0;
  int count = 0;
  for (const CornerList face : cell_faces(cell.kind)) {
    const std::size_t edges = dim == 2 ? 1 : face.size();
    for (std::size_t i = 0; i < edges; ++i, ++count) {
      sum += (mesh.nodes[cell.nodes[face[(i + 1) % face.size()]]] - mesh.nodes[cell.nodes[face[i]]]).norm();
    }
  }
  return sum / count;
}

}  // namespace

template <int dim>
SimplexList<Simplex<dim>> both_splits(const BlockMesh<dim>& mesh, CellId cell) {
  const auto& [kind, nodes] = mesh.cells[cell];
  SimplexList<Simplex<dim>> simplices;
  for (const CornerList& corners : mixed_simplices(kind)) {
    Simplex<dim> simplex;
    for (std::size_t i = 0; i <= dim; ++i) simplex[i] = nodes[corners[i]];
    simplices.push_back(simplex);
  }
  return simplices;
}

template <int dim>
CellOfElement<dim>::CellOfElement(const BlockMesh<dim>& mesh) : cells_(mesh.cells.empty() ? 0 : mesh.elements.size()) {
  for (const Block& block : mesh.blocks) {
    auto element = block.elements.begin();
    for (const CellId cell : block.cells) {
      for (std::size_t i = 0; i < split_count(mesh.cells[cell].kind); ++i, ++element) cells_[*element] = cell;
    }
  }
}

template <int dim>
CharacteristicLength<dim>::CharacteristicLength(const BlockMesh<dim>& mesh) : mesh_(mesh), cells_(mesh) {}

template <int dim>
double CharacteristicLength<dim>::of(ElementId element) const {
  const CellId cell = cells_[element];
  return cell.valid() ? cell_mean_edge(mesh_, mesh_.cells[cell]) : element_mean_edge(mesh_, element);
}

std::optional<std::array<NodeId, 4>> quadrilateral_of(const Cell& cell, const std::array<NodeId, 3>& corners) {
  for (const CornerList face : cell_faces(cell.kind)) {
    if (face.size() != 4) continue;
    std::array<NodeId, 4> nodes;
    std::transform(face.begin(), face.end(), nodes.begin(), [&](std::size_t corner) { return cell.nodes[corner]; });
    const auto other = [&](NodeId node) { return std::find(corners.begin(), corners.end(), node) == corners.end(); };
    if (std::count_if(nodes.begin(), nodes.end(), other) != 1) continue;
    const auto fourth = std::find_if(nodes.begin(), nodes.end(), other);
    std::rotate(nodes.begin(), fourth + 1, nodes.end());  // a whole turn where it is the last
    return nodes;
  }
  return std::nullopt;
}

template <int dim>
Table<FaceId, WeightedFace<dim>> weighted_faces(const BlockMesh<dim>& mesh) {
  Table<FaceId, Face<dim>> of_elements;
  Table<FaceId, WeightedFace<dim>> of_cells;
  for (const BlockId block : mesh.blocks.ids()) {
    if (dim == 2 || mesh.blocks[block].cells.size() == 0) {  // in 2-D a cell has the edges of its triangles
      add_boundary_faces(mesh, block, of_elements);
    } else if constexpr (dim == 3) {
      add_cell_block(mesh, block, of_cells);
    }
  }
  Table<FaceId, WeightedFace<dim>> faces;
  faces.reserve(of_elements.size() + of_cells.size());
  for (const Face<dim>& face : of_elements) faces.push_back({face, 1});
  for (const WeightedFace<dim>& face : of_cells) faces.push_back(face);
  return faces;
}

template class CellOfElement<2>;
template class CellOfElement<3>;
template class CharacteristicLength<2>;
template class CharacteristicLength<3>;

#define SCREE_INSTANTIATE(dim)                                                        \
  template SimplexList<Simplex<dim>> both_splits<dim>(const BlockMesh<dim>&, CellId); \
  template Table<FaceId, WeightedFace<dim>> weighted_faces<dim>(const BlockMesh<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::mesh
