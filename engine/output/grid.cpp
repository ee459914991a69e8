#include "engine/output/series.h"

namespace scree::output {

template <int dim>
Grid make_grid(const mesh::BlockMesh<dim>& mesh) {
  Grid grid;
  grid.type = dim == 2 ? CellType::triangle : CellType::tetrahedron;
  grid.points.reserve(mesh.nodes.size());
  for (const Point<dim>& node : mesh.nodes) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<dim>() = node;
    grid.points.push_back(point);
  }
  grid.connectivity.reserve(mesh.elements.size() * (dim + 1));
  for (const auto& element : mesh.elements) {
    for (const NodeId node : element) grid.connectivity.push_back(node.value());
  }
  return grid;
}

template Grid make_grid(const mesh::BlockMesh<2>&);
template Grid make_grid(const mesh::BlockMesh<3>&);

}  // namespace scree::output
