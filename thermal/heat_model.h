// The semi-discrete heat balance C dT/dt = -K T + Q of blocks and contacts.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact/contact_set.h"
#include "engine/base/material.h"
#include "thermal/heat_options.h"

namespace scree::thermal {

using SparseMatrix = Eigen::SparseMatrix<double>;

// One row per node of the mesh, in its order. K is symmetric with zero row sums.
struct HeatModel {
  Table<NodeId, BlockId> blocks;      // of each node, for messages
  Eigen::VectorXd capacity;           // lumped, eq. (7) [J/K]
  SparseMatrix conductance;           // blocks, eq. (4)-(5), and contacts, eq. (11)-(13) [W/K]
  Eigen::VectorXd load;               // applied flow and sources, Q_app of eq. (6) [W]
  Eigen::VectorXd initial;            // [K]
  std::vector<NodeId> fixed_nodes;    // ascending
  Eigen::VectorXd fixed_temperature;  // of those nodes [K]
  // For the ledger, by name: what boundary holds each fixed node (index into `boundary_names`), and the load of each boundary
  // and source by itself.
  std::vector<int> fixed_boundary;
  std::vector<std::string> boundary_names;
  std::vector<std::pair<std::string, double>> applied_flows;  // [W]
};

// Throws InputError for a block without conductivity, specific heat, density or initial temperature, and for a boundary or
// source whose region holds nothing.
template <int dim>
HeatModel make_heat_model(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::ContactSet<dim>& contacts, const HeatOptions& options);

// Heat flux of each cell as a series shows them, block by block: its cells, or its elements if it has none [W/m2].
template <int dim>
std::vector<Point<dim>> cell_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                    const Eigen::VectorXd& temperature);

// Heat flux of each element, eq. (4) [W/m2].
template <int dim>
std::vector<Point<dim>> element_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                       const Eigen::VectorXd& temperature);

}  // namespace scree::thermal
