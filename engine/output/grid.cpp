#include "engine/output/frame.h"

namespace scree::output {

namespace {

CellType type_of(mesh::CellKind kind) {
  if (kind == mesh::CellKind::quadrilateral) return CellType::quadrilateral;
  return kind == mesh::CellKind::wedge ? CellType::wedge : CellType::hexahedron;
}

template <int dim>
void add_block(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block, Grid& grid) {
  for (const CellId c : block.cells) {
    const mesh::Cell& cell = mesh.cells[c];
    grid.types.push_back(type_of(cell.kind));
    for (std::size_t i = 0; i < mesh::corner_count(cell.kind); ++i) grid.connectivity.push_back(cell.nodes[i].value());
  }
  if (block.cells.size() > 0) return;
  for (const ElementId e : block.elements) {
    grid.types.push_back(dim == 2 ? CellType::triangle : CellType::tetrahedron);
    for (const NodeId node : mesh.elements[e]) grid.connectivity.push_back(node.value());
  }
}

}  // namespace

template <int dim>
Grid make_grid(const mesh::BlockMesh<dim>& mesh) {
  Grid grid;
  grid.points.reserve(mesh.nodes.size());
  for (const Point<dim>& node : mesh.nodes) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<dim>() = node;
    grid.points.push_back(point);
  }
  grid.connectivity.reserve(mesh.elements.size() * (dim + 1));
  for (const mesh::Block& block : mesh.blocks) add_block(mesh, block, grid);
  return grid;
}

template Grid make_grid(const mesh::BlockMesh<2>&);
template Grid make_grid(const mesh::BlockMesh<3>&);

}  // namespace scree::output
