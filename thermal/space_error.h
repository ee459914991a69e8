// How far the piecewise linear temperatures are from the true ones inside the elements: an estimate in kelvin.
//
// Between its nodes a linear temperature misses about |T''| h^2/8. Two sources tell of T'':
// - the recovered flux q* (Zienkiewicz & Zhu 1987), the mean of the elements' fluxes around each node of a block, which is of
//   higher order than q itself. Where T'' is constant K^-1 (q* - q) grows linearly to T'' h/2, so that h sqrt(3)/4 times its
//   root mean square is T'' h^2/8;
// - the heat balance of the element, k T'' = rho c dT/dt with the least k of all directions, which is all there is in a block
//   of one element. Sources in such a block are not seen.
// The larger of the two counts. Nothing is known of what a coarse mesh makes of a joint; refine, or compare with another mesh.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

struct SpaceError {
  std::vector<double> of_element;  // [K]
  double largest = 0;              // of them [K]
  // |q* - q| over |q*|, both in the energy norm (weighted by K^-1) [-].
  // Over the blocks of more than one element; nothing if there are none, since one element cannot be smoothed.
  std::optional<double> relative;
};

// `rate` is dT/dt of every node [K/s].
template <int dim>
SpaceError estimate_space_error(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                const Eigen::VectorXd& temperature, const Eigen::VectorXd& rate);

// dT/dt = C^-1 (Q - K T), 0 at held nodes [K/s].
Eigen::VectorXd temperature_rate(const HeatModel& model, const Eigen::VectorXd& temperature, double time);

}  // namespace scree::thermal
