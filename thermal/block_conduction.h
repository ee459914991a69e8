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
// In numbers only: loops over many elements take some of them at once. point(corner, axis), value(corner).
template <int dim, class PointAt, class ValueAt>
SCREE_INLINE std::array<double, dim> gradient(const PointAt& point, const ValueAt& value) {
  std::array<std::array<double, dim>, dim> ways;
  std::array<double, dim> rises;
  for (int a = 0; a < dim; ++a) {
    for (int i = 0; i < dim; ++i) ways[a][i] = point(a + 1, i) - point(0, i);
    rises[a] = value(a + 1) - value(0);
  }
  std::array<double, dim> sum{};
  double scale = 0;
  if constexpr (dim == 2) {
    scale = 1 / (ways[0][0] * ways[1][1] - ways[0][1] * ways[1][0]);
    sum = {rises[0] * ways[1][1] - rises[1] * ways[0][1], rises[1] * ways[0][0] - rises[0] * ways[1][0]};
  } else {
    double volume = 0;  // six times
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const auto across = [&](int a, int b) SCREE_INLINED { return ways[a][j] * ways[b][k] - ways[a][k] * ways[b][j]; };
      volume += ways[0][i] * across(1, 2);
      sum[i] = rises[0] * across(1, 2) + rises[1] * across(2, 0) + rises[2] * across(0, 1);
    }
    scale = 1 / volume;
  }
  for (double& along : sum) along *= scale;
  return sum;
}

// q of eq. (4) [W/m2] at a gradient of temperature [K/m] and conductivity k [W/m/K], a number or a Tensor.
template <int dim, class Conductivity>
SCREE_INLINE Point<dim> flux(const Conductivity& conductivity, const Point<dim>& gradient) {
  return -(conductivity * gradient);
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
