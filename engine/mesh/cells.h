// Cells that are more than a simplex, as conduction sees them: by the mixed discretisation of Li and Feng (2016), both of a
// cell's overlapping splits with half the weight each.
#pragma once

#include <optional>

#include "engine/mesh/block_mesh.h"

namespace scree::mesh {

template <int dim>
using Simplex = std::array<NodeId, dim + 1>;

// The simplices of both splits of a cell, positively oriented, those of the first split first.
template <int dim>
SimplexList<Simplex<dim>> both_splits(const BlockMesh<dim>& mesh, CellId cell);

// Calls `visit(nodes, weight)` with every simplex that makes up a block for conduction, storage and sources: its elements with
// weight 1, or both splits of its cells with weight 1/2.
template <int dim, class Visit>
void for_each_simplex(const BlockMesh<dim>& mesh, const Block& block, const Visit& visit) {
  for (const CellId cell : block.cells) {
    for (const Simplex<dim>& simplex : both_splits(mesh, cell)) visit(simplex, 0.5);
  }
  if (block.cells.size() > 0) return;
  for (const ElementId e : block.elements) visit(mesh.elements[e], 1.0);
}

// The cell that an element is a part of; not valid for one of a block without cells. No table where no block has any.
template <int dim>
class CellOfElement {
 public:
  CellOfElement() = default;  // of a mesh without cells
  explicit CellOfElement(const BlockMesh<dim>& mesh);
  [[nodiscard]] CellId operator[](ElementId element) const { return cells_.empty() ? CellId{} : cells_[element]; }

 private:
  Table<ElementId, CellId> cells_;
};

// The characteristic length of eq. (11): the mean length of the edges of an element, or of the cell that it is a part of, so
// that it does not depend on how the cell is split [m].
template <int dim>
class CharacteristicLength {
 public:
  explicit CharacteristicLength(const BlockMesh<dim>& mesh);  // of the caller, who keeps it
  [[nodiscard]] double of(ElementId element) const;

 private:
  const BlockMesh<dim>& mesh_;
  CellOfElement<dim> cells_;
};

// The face of the cell that these corners and one more make up, the corners in turn and that one last; nothing if they are a
// face by themselves.
std::optional<std::array<NodeId, 4>> quadrilateral_of(const Cell& cell, const std::array<NodeId, 3>& corners);

// A part of a block's surface as heat passes it, with the weight of its area; of a cell's face the element is not valid.
template <int dim>
struct WeightedFace : Face<dim> {
  double weight = 1;
};

// The boundary of every block: the faces of elements, and quadrilateral faces of cells as the four triangles of both their
// diagonals, half each, as both splits see them.
template <int dim>
Table<FaceId, WeightedFace<dim>> weighted_faces(const BlockMesh<dim>& mesh);

}  // namespace scree::mesh
