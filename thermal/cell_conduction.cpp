#include "thermal/cell_conduction.h"

#include <algorithm>

#include "engine/mesh/simplex_mesh.h"
#include "thermal/fourth_order.h"

namespace scree::thermal {

namespace {

constexpr double weight_of_split = 0.5;

template <int dim>
std::array<Point<dim>, dim + 1> chosen(const CellPoints<dim>& points, mesh::CornerList corners) {
  std::array<Point<dim>, dim + 1> simplex;
  for (std::size_t a = 0; a <= dim; ++a) simplex[a] = points[corners[a]];
  return simplex;
}

}  // namespace

template <int dim>
CornerOfCell corner_of_cell(mesh::CellKind kind, const CellPoints<dim>& points, const Tensor<dim>& conductivity, int corner,
                            SpaceOrder order) {
  CornerOfCell result;
  for (const mesh::CornerList corners : mesh::mixed_simplices(kind)) {
    const auto found = std::find(corners.begin(), corners.end(), static_cast<std::size_t>(corner));
    if (found == corners.end()) continue;
    const auto row = found - corners.begin();
    const std::array<Point<dim>, dim + 1> simplex = chosen<dim>(points, corners);
    const CornerMatrix<dim> conductance = element_conductance<dim>(Corners<dim>(simplex[0].data()), conductivity);
    for (int a = 0; a <= dim; ++a) result.conductance[corners[a]] += weight_of_split * conductance(row, a);
    result.volume += weight_of_split * mesh::signed_volume<dim>(simplex);
  }
  if (order == SpaceOrder::fourth) make_fourth_order<dim>(kind, points, conductivity, corner, result);
  return result;
}

template <int dim>
CellPoints<dim> cell_points(const mesh::BlockMesh<dim>& mesh, const mesh::Cell& cell) {
  CellPoints<dim> points;
  for (std::size_t i = 0; i < mesh::corner_count(cell.kind); ++i) points[i] = mesh.nodes[cell.nodes[i]];
  return points;
}

#define SCREE_INSTANTIATE(dim)                                                                                            \
  template CornerOfCell corner_of_cell<dim>(mesh::CellKind, const CellPoints<dim>&, const Tensor<dim>&, int, SpaceOrder); \
  template CellPoints<dim> cell_points<dim>(const mesh::BlockMesh<dim>&, const mesh::Cell&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
