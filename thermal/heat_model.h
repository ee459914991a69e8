// The semi-discrete heat balance C dT/dt = -K T + Q of blocks and contacts.
#pragma once

#include <set>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "contact/contact_set.h"
#include "engine/base/material.h"
#include "thermal/heat_options.h"
#include "thermal/joint_conduction.h"
#include "thermal/lumped_blocks.h"
#include "thermal/node_map.h"

namespace scree::thermal {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Nodes and what each has of a surface or a volume; a row of a lumped block may occur many times.
struct NodeShares {
  std::vector<NodeId> nodes;
  std::vector<double> shares;  // [m2] or [m3]
  Eigen::Matrix3Xd places;     // where each is, for functions of place [m]
};

// A temperature that nodes are held at.
struct Hold {
  std::string name;
  Function temperature;  // [K]
};

// Heat that comes in whatever the temperature, Q_app of eq. (6): a flux or a power, times the nodes' shares.
struct Load {
  std::string name;
  NodeShares on;
  Function density;        // [W/m2] or [W/m3]; a total flow [W] has shares that add up to 1
  bool in_volume = false;  // a source in elements
  double of_share = 1;     // what a share of 1 stands for: the whole area of a total flow [m2 or m3]
};

// Heat exchanged with surroundings: the equations stand in exchange.h.
struct Exchange {
  enum class Law { convection, radiation };
  std::string name;
  NodeShares on;  // [m2]
  Law law = Law::convection;
  Function coefficient;   // h [W/m2/K], or the emissivity [-]
  Function surroundings;  // [K]
};

// Properties that depend on the temperature. A node belongs to one block, so it has one material.
struct VaryingProperties {
  Table<NodeId, int> material;       // which entry of the two lists
  std::vector<Curve> specific_heat;  // [J/kg/K]
  std::vector<Curve> conductivity;   // along the axis whose ratio is 1 [W/m/K]
  Eigen::VectorXd mass;              // of each node [kg]
  // Of the blocks whose conductivity depends on temperature, at 1 W/m/K [m]; not in HeatModel::conductance. Empty if there are
  // none.
  SparseMatrix unit_conductance;
};

// Of the cells of a grid, each by itself (fastest_cell.h).
struct FastestCell {
  double rate = 0;  // largest eigenvalue of C_e^-1 K_e [1/s]
  double gain = 1;  // largest eigenvalue of I + C_e^-1 B_e [-]
};

// One row per node of the mesh, in its order, but one for all nodes of a lumped block and one for nodes that are tied; NodeId
// counts rows here. K is symmetric with zero row sums.
struct HeatModel {
  NodeMap rows;                                 // of the mesh's nodes
  Table<NodeId, BlockId> blocks;                // of each row, for messages
  Eigen::Matrix3Xd places;                      // of each row, for functions of place: a lumped block's first node [m]
  Eigen::VectorXd capacity;                     // lumped, eq. (7) [J/K]
  SparseMatrix conductance;                     // blocks, eq. (4)-(5), and contacts, eq. (11)-(13) [W/K]
  std::optional<SparseMatrix> shared_capacity;  // B of fourth_order.h; nothing in second order [J/K]
  Eigen::VectorXd initial;                      // [K]
  std::vector<NodeId> fixed_nodes;              // ascending
  std::vector<int> fixed_hold;                  // which of `holds` holds each of them
  // What acts from outside, each an entry of the ledger.
  std::vector<Hold> holds;
  std::vector<Load> loads;
  std::vector<Exchange> exchanges;
  // Nothing if no property depends on temperature; `capacity` is that of the initial temperatures otherwise.
  std::optional<VaryingProperties> varying;
  std::optional<LumpedBlocks> lumped;       // nothing if every block is meshed
  std::optional<FastestCell> fastest_cell;  // of equal cells without joints
  std::size_t tied_nodes = 0;               // those that are one with an earlier node (tied_nodes.h)
  // For messages.
  Table<BlockId, BodyId> bodies;
  Table<BodyId, std::string> body_names;
};

// Whether F(T, t) is linear in T with coefficients that do not change: what the linear schemes need.
bool has_constant_properties(const HeatModel& model);

// Bodies whose blocks are not yet where they will be heated.
using MovingBodies = std::set<BodyId>;

// Throws the InputError that a model of these blocks would be refused with, as far as it can be known before contacts are
// looked for and while some bodies still move.
template <int dim>
void check_heat_options(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                        const HeatOptions& options, const MovingBodies& moving);

// Throws InputError for a block without conductivity, specific heat, density or initial temperature, and for a boundary or
// source whose region holds nothing.
template <int dim>
HeatModel make_heat_model(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::ContactSet<dim>& contacts, const HeatOptions& options);
// Where the conduction of the contacts is known already.
template <int dim>
HeatModel make_heat_model(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::ContactSet<dim>& contacts, const JointConduction& joints, const HeatOptions& options);

}  // namespace scree::thermal
