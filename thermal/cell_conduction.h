// Conduction and storage of a quadrilateral, wedge or hexahedron: the simplices of both its splits with half the weight each
// (mixed discretisation, engine/mesh/cells.h), one corner at a time.
#pragma once

#include <array>

#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"
#include "thermal/heat_options.h"

namespace scree::thermal {

template <int dim>
using CellPoints = std::array<Point<dim>, 8>;  // of the corners; those beyond them count for nothing [m]

// What the nodes of a cell have of it; corners that the kind does not have are zero.
struct CornerOfCell {
  std::array<double, 8> conductance{};  // K between this corner and each: K_ab and K_ba are the same to the bit [W/K]
  double volume = 0;                    // of the simplices at this corner, weighted [m3]
  std::array<double, 8> shared{};       // B of fourth_order.h, over density and specific heat; zero in second order [m3]
};

// In fourth order blended with the multilinear element (fourth_order.h).
template <int dim>
CornerOfCell corner_of_cell(mesh::CellKind kind, const CellPoints<dim>& points, const Tensor<dim>& conductivity, int corner,
                            SpaceOrder order = SpaceOrder::second);

template <int dim>
CellPoints<dim> cell_points(const mesh::BlockMesh<dim>& mesh, const mesh::Cell& cell);

}  // namespace scree::thermal
