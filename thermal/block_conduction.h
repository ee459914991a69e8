// Conduction and storage inside one simplex, which cells with more corners are made of (engine/mesh/cells.h) (Li & Feng 2016,
// section 1.2): the home of eqs. (4), (5) and (7).
//
// Eq. (4): q = -(k/V) sum_f Tbar_f S_f, the element's flux from the mean temperatures Tbar_f of its faces, S_f = n dS their
// outward area vectors. Eq. (5): a node receives sum_f q . S_f / N_f over the element's faces that contain it, N_f = dim nodes
// each. A face contains a corner unless it is the one opposite to it, and the area vectors of a closed surface sum to zero, so
// with S_a the area vector opposite to corner a both sums collapse:
//   q = k/(dim V) sum_a S_a T_a,    Q_a = -q . S_a / dim = -sum_b K_ab T_b,    K_ab = k S_a . S_b / (dim^2 V),
// which is the linear finite element k V grad N_a . grad N_b. A test evaluates (4) and (5) as printed beside it.
#pragma once

#include <Eigen/Core>

#include "engine/mesh/block_mesh.h"

namespace scree::thermal {

// One column per corner of an element.
template <int dim>
using Corners = Eigen::Matrix<double, dim, dim + 1>;

template <int dim>
using CornerValues = Eigen::Matrix<double, dim + 1, 1>;

template <int dim>
using CornerMatrix = Eigen::Matrix<double, dim + 1, dim + 1>;

template <int dim>
Corners<dim> corner_points(const mesh::BlockMesh<dim>& mesh, const std::array<NodeId, dim + 1>& nodes);  // [m]

// Outward area vectors S_a of the faces opposite to each corner [m2] (2-D: times unit thickness).
template <int dim>
Corners<dim> opposite_areas(const Corners<dim>& points);

// q of eq. (4) [W/m2], at corner temperatures [K] and conductivity k [W/m/K].
template <int dim>
Point<dim> element_flux(const Corners<dim>& points, double conductivity, const CornerValues<dim>& temperatures);

// K_ab of eqs. (4)-(5) [W/K]: exactly symmetric, and each diagonal is minus the sum of its row.
template <int dim>
CornerMatrix<dim> element_conductance(const Corners<dim>& points, double conductivity);

// A corner's share of the element's capacity, rho C V_n of eq. (7) [J/K]; rho C [J/m3/K].
template <int dim>
double corner_capacity(double volume, double volumetric_heat) {
  return volumetric_heat * volume / (dim + 1);
}

}  // namespace scree::thermal
