// Conduction and storage inside one simplex, which cells with more corners are made of (engine/mesh/cells.h) (Li & Feng 2016,
// section 1.2): the home of eqs. (4), (5) and (7).
//
// Eq. (4): q = -(k/V) sum_f Tbar_f S_f, the element's flux from the mean temperatures Tbar_f of its faces, S_f = n dS their
// outward area vectors. Eq. (5): a node receives sum_f q . S_f / N_f over the element's faces that contain it, N_f = dim nodes
// each. A face contains a corner unless it is the one opposite to it, and the area vectors of a closed surface sum to zero, so
// with S_a the area vector opposite to corner a both sums collapse:
//   q = k/(dim V) sum_a S_a T_a,    Q_a = -q . S_a / dim = -sum_b K_ab T_b,    K_ab = k S_a . S_b / (dim^2 V),
// which is the linear finite element k V grad N_a . grad N_b. A test evaluates (4) and (5) as printed beside it.
// A conductivity that depends on direction is a symmetric tensor k in the same places: q = k/(dim V) sum_a S_a T_a, K_ab = S_a
// . k S_b / (dim^2 V).
#pragma once

#include <array>

#include <Eigen/Core>

#include "engine/base/material.h"
#include "engine/base/wide.h"
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
using Tensor = Eigen::Matrix<double, dim, dim>;

// Conductivity of a block over its material's value: R diag(ratio) R^T, R the principal axes, which turn with the block [-].
template <int dim>
Tensor<dim> conductivity_ratios(const Conductivity& conductivity, const mesh::Block& block);

template <int dim>
Corners<dim> corner_points(const mesh::BlockMesh<dim>& mesh, const std::array<NodeId, dim + 1>& nodes) {  // [m]
  Corners<dim> points;
  for (int a = 0; a <= dim; ++a) points.col(a) = mesh.nodes[nodes[a]];
  return points;
}

// Outward area vectors S_a of the faces opposite to each corner [m2] (2-D: times unit thickness).
template <int dim>
Corners<dim> opposite_areas(const Corners<dim>& points);

// Of the linear function that has these values at the corners, which is -1/(dim V) sum_a S_a T_a. Differences from one corner,
// as the areas sum to zero only to rounding, and temperatures in kelvin are large: the area opposite to that corner drops out,
// and a frame asks for this of every element.
template <int dim>
SCREE_INLINE Point<dim> gradient(const Corners<dim>& points, const CornerValues<dim>& values) {
  std::array<Point<dim>, dim> ways;
  std::array<double, dim> rises;
  for (int a = 0; a < dim; ++a) {
    ways[a] = points.col(a + 1) - points.col(0);
    rises[a] = values[a + 1] - values[0];
  }
  if constexpr (dim == 2) {
    const auto across = [](const Point<2>& way) { return Point<2>(way[1], -way[0]); };
    return 1 / ways[0].dot(across(ways[1])) * (rises[0] * across(ways[1]) - rises[1] * across(ways[0]));
  } else {
    const Point<3> across = ways[1].cross(ways[2]);
    return 1 / ways[0].dot(across) *
           (rises[0] * across + rises[1] * ways[2].cross(ways[0]) + rises[2] * ways[0].cross(ways[1]));
  }
}

// q of eq. (4) [W/m2], at corner temperatures [K] and conductivity k [W/m/K], a number or a Tensor.
template <int dim, class Conductivity>
SCREE_INLINE Point<dim> element_flux(const Corners<dim>& points, const Conductivity& conductivity,
                                     const CornerValues<dim>& temperatures) {
  return -(conductivity * gradient<dim>(points, temperatures));
}

// K_ab of eqs. (4)-(5) [W/K]: exactly symmetric, and each diagonal is minus the sum of its row.
template <int dim>
CornerMatrix<dim> element_conductance(const Corners<dim>& points, const Tensor<dim>& conductivity);

// A corner's share of the element's mass, rho V_n of eq. (7) [kg]; density in kg/m3.
template <int dim>
double corner_mass(double volume, double density) {
  return density * volume / (dim + 1);
}

}  // namespace scree::thermal
