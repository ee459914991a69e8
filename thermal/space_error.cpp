#include "thermal/space_error.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "thermal/block_conduction.h"
#include "thermal/fluxes.h"
#include "thermal/heat_balance.h"

namespace scree::thermal {

namespace {

// The mean of the fluxes of the elements around each node, weighted by volume. No node belongs to two blocks.
template <int dim>
std::vector<Point<dim>> recovered_fluxes(const mesh::BlockMesh<dim>& mesh, const std::vector<Point<dim>>& fluxes) {
  std::vector<Point<dim>> sums(mesh.nodes.size(), Point<dim>::Zero());
  std::vector<double> volumes(mesh.nodes.size(), 0.0);
  for (const ElementId e : mesh.elements.ids()) {
    const double volume = mesh::element_volume(mesh, e);
    for (const NodeId node : mesh.elements[e]) {
      sums[node.index()] += volume * fluxes[e.index()];
      volumes[node.index()] += volume;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= volumes[i];
  return sums;
}

// K^-1 of a block times its material's conductivity [-]. Where that is the same in all directions, the identity to the bit.
template <int dim>
struct Resistivity {
  explicit Resistivity(const Tensor<dim>& ratios) : whole(Tensor<dim>::Identity()), root(whole) {
    if (ratios == whole) return;
    const Eigen::SelfAdjointEigenSolver<Tensor<dim>> axes(ratios);
    root = axes.operatorInverseSqrt();
    whole = root * root;
    largest = 1 / axes.eigenvalues().minCoeff();
  }

  Tensor<dim> whole;
  Tensor<dim> root;  // whose square it is
  double largest = 1;
};

// Mean over a simplex of the square of a linear vector field, from its corner values.
template <int dim>
double mean_square(const std::array<Point<dim>, dim + 1>& corners) {
  Point<dim> sum = Point<dim>::Zero();
  double squares = 0;
  for (const Point<dim>& corner : corners) {
    sum += corner;
    squares += corner.squaredNorm();
  }
  return (squares + sum.squaredNorm()) / ((dim + 1) * (dim + 2));
}

}  // namespace

template <int dim>
SpaceError estimate_space_error(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                const Eigen::VectorXd& temperature, const Eigen::VectorXd& rate) {
  const std::vector<Point<dim>> fluxes = element_fluxes(mesh, materials, temperature);
  const std::vector<Point<dim>> recovered = recovered_fluxes(mesh, fluxes);
  SpaceError error;
  error.of_element.resize(mesh.elements.size());
  double missed = 0;
  double whole = 0;
  for (const mesh::Block& block : mesh.blocks) {
    const Material& material = materials[mesh.bodies[block.body].material];
    const Resistivity<dim> resistivity(conductivity_ratios<dim>(*material.conductivity, block));
    for (const ElementId e : block.elements) {
      std::array<Point<dim>, dim + 1> curved, gap, smooth;
      double mean_rate = 0;
      double mean_temperature = 0;
      for (int i = 0; i <= dim; ++i) {
        const NodeId node = mesh.elements[e][i];
        const Point<dim> missing = recovered[node.index()] - fluxes[e.index()];
        curved[i] = resistivity.whole * missing;
        gap[i] = resistivity.root * missing;
        smooth[i] = resistivity.root * recovered[node.index()];
        mean_rate += rate[node.value()] / (dim + 1);
        mean_temperature += temperature[node.value()] / (dim + 1);
      }
      const double k = material.conductivity->value(mean_temperature);
      const double volumetric_heat = *material.density * (*material.specific_heat)(mean_temperature);
      const double volume = mesh::element_volume(mesh, e);
      if (block.elements.size() > 1) {
        missed += volume / k * mean_square<dim>(gap);
        whole += volume / k * mean_square<dim>(smooth);
      }
      const double h = mesh::element_mean_edge(mesh, e);
      const double bulge = volumetric_heat * std::abs(mean_rate) * h * h / (8 * k) * resistivity.largest;
      error.of_element[e.index()] = std::max(std::sqrt(3 * mean_square<dim>(curved)) / 4 * h / k, bulge);
      error.largest = std::max(error.largest, error.of_element[e.index()]);
    }
  }
  if (whole > 0) error.relative = std::sqrt(missed / whole);
  return error;
}

Eigen::VectorXd temperature_rate(const HeatModel& model, const Eigen::VectorXd& temperature, double time) {
  Drives drives(model);
  const HeatBalance balance(model);
  const Drive& drive = drives.at(time);
  Eigen::VectorXd rate = balance.heating(temperature, drive).cwiseQuotient(balance.linearised(temperature, drive).capacity);
  for (const NodeId node : model.fixed_nodes) rate[node.value()] = 0;
  return rate;
}

template SpaceError estimate_space_error<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                            const Eigen::VectorXd&, const Eigen::VectorXd&);
template SpaceError estimate_space_error<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                            const Eigen::VectorXd&, const Eigen::VectorXd&);

}  // namespace scree::thermal
