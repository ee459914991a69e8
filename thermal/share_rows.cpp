#include "thermal/share_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/check.h"
#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"
#include "thermal/incidence.h"
#include "thermal/row_assembly.h"
#include "thermal/row_order.h"

namespace scree::thermal {

namespace {

// The row of each node, and the first node of each row.
struct Numbering {
  Table<NodeId, NodeId> rows;
  std::vector<NodeId> nodes;
};

template <int dim>
Numbering number_rows(const mesh::BlockMesh<dim>& mesh, const HeatModel& model,
                      const std::optional<Table<NodeId, NodeId>>& tied) {
  Table<NodeId, NodeId> first(mesh.nodes.size());  // of those that share a row
  Numbering numbering;
  for (const BlockId b : mesh.blocks.ids()) {
    const bool one_row = model.lumped && model.lumped->contain(b);
    for (const NodeId node : mesh.blocks[b].nodes) {
      first[node] = one_row ? mesh.blocks[b].nodes[0] : tied ? (*tied)[node] : node;
      if (first[node] == node) numbering.nodes.push_back(node);
    }
  }
  if (is_worth_ordering(mesh)) numbering.nodes = in_space_order(std::move(numbering.nodes), model.blocks, model.places);
  numbering.rows = Table<NodeId, NodeId>(mesh.nodes.size());
  for (std::size_t row = 0; row < numbering.nodes.size(); ++row) numbering.rows[numbering.nodes[row]] = NodeId(row);
  for (const NodeId node : mesh.nodes.ids()) numbering.rows[node] = numbering.rows[first[node]];
  return numbering;
}

struct MeanTemperature {
  double mass = 0;    // [kg]
  double mean = 0;    // [K]
  double spread = 0;  // [K]
};

// Differences from one of them, so that equal temperatures have that mean to the bit.
template <int dim>
MeanTemperature mean_temperature(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block, double density,
                                 const Eigen::VectorXd& temperature) {
  MeanTemperature result;
  const double reference = temperature[block.nodes[0].value()];
  double sum = 0;
  mesh::for_each_simplex(mesh, block, [&](const mesh::Simplex<dim>& nodes, double weight) {
    const double share = weight * corner_mass<dim>(mesh::simplex_volume<dim>(mesh, nodes), density);
    for (const NodeId node : nodes) {
      result.mass += share;
      sum += share * (temperature[node.value()] - reference);
    }
  });
  result.mean = reference + sum / result.mass;
  for (const NodeId node : block.nodes) {
    result.spread = std::max(result.spread, std::abs(temperature[node.value()] - result.mean));
  }
  return result;
}

Eigen::VectorXd of_rows(const Eigen::VectorXd& of_nodes, const Numbering& numbering) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(numbering.nodes.size()));
  Eigen::Index row = 0;
  for (const NodeId node : numbering.nodes) values[row++] = of_nodes[node.value()];
  return values;
}

Eigen::VectorXd summed(const Eigen::VectorXd& of_nodes, const Numbering& numbering) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbering.nodes.size()));
  for (const NodeId node : numbering.rows.ids()) sums[numbering.rows[node].value()] += of_nodes[node.value()];
  return sums;
}

// The mean by capacity of each row's nodes, as a difference to the first of them, so that equal temperatures have it to the
// bit.
Eigen::VectorXd mean(const Eigen::VectorXd& of_nodes, const Eigen::VectorXd& capacity, const Eigen::VectorXd& row_capacity,
                     const Numbering& numbering) {
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(of_nodes.size());
  for (const NodeId node : numbering.rows.ids()) {
    const NodeId first = numbering.nodes[numbering.rows[node].index()];
    difference[node.value()] = capacity[node.value()] * (of_nodes[node.value()] - of_nodes[first.value()]);
  }
  const Eigen::VectorXd sums = summed(difference, numbering);
  Eigen::VectorXd means = of_rows(of_nodes, numbering);
  for (Eigen::Index row = 0; row < means.size(); ++row) {
    if (sums[row] != 0) means[row] += sums[row] / row_capacity[row];
  }
  return means;
}

// P^T K P. Each of its entries is a sum over blocks, in the order of their nodes: the same for an entry and its mirror image.
SparseMatrix of_rows(const SparseMatrix& of_nodes, const Numbering& numbering) {
  const Incidence nodes_of(numbering.nodes.size(), [&](const auto& visit) {
    for (const NodeId node : numbering.rows.ids())
      visit(numbering.rows[node].value(), static_cast<std::uint32_t>(node.index()));
  });
  return assembled(static_cast<int>(numbering.nodes.size()), [&](int row, RowSum& sum) {
    for (const std::uint32_t node : nodes_of.of(row)) {
      for (SparseMatrix::InnerIterator entry(of_nodes, static_cast<Eigen::Index>(node)); entry; ++entry) {
        sum.add(numbering.rows[NodeId(static_cast<std::size_t>(entry.row()))].value(), entry.value());
      }
    }
    return 1.0;
  });
}

// A node's entry becomes its row's; equal ones are added up unless a function makes them differ from place to place.
NodeShares of_rows(const NodeShares& on, const Numbering& numbering, bool by_place) {
  NodeShares result;
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < on.nodes.size(); ++i) {
    const NodeId row = numbering.rows[on.nodes[i]];
    if (!by_place && !result.nodes.empty() && result.nodes.back() == row) {
      result.shares.back() += on.shares[i];
      continue;
    }
    result.nodes.push_back(row);
    result.shares.push_back(on.shares[i]);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  result.places = on.places(Eigen::all, kept);
  return result;
}

void number_conditions(const Numbering& numbering, HeatModel& model) {
  std::map<NodeId, int> holds;
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    holds.emplace(numbering.rows[model.fixed_nodes[i]], model.fixed_hold[i]);
  }
  model.fixed_nodes.clear();
  model.fixed_hold.clear();
  for (const auto& [row, hold] : holds) {
    model.fixed_nodes.push_back(row);
    model.fixed_hold.push_back(hold);
  }
  for (Load& load : model.loads) load.on = of_rows(load.on, numbering, load.density.varies_in_place());
  for (Exchange& exchange : model.exchanges) {
    const bool by_place = exchange.coefficient.varies_in_place() || exchange.surroundings.varies_in_place();
    exchange.on = of_rows(exchange.on, numbering, by_place);
  }
}

void number_properties(const Numbering& numbering, VaryingProperties& varying) {
  Table<NodeId, int> material;
  for (const NodeId node : numbering.nodes) material.push_back(varying.material[node]);
  varying.material = std::move(material);
  varying.mass = of_rows(varying.mass, numbering);
  if (varying.unit_conductance.rows() > 0) varying.unit_conductance = of_rows(varying.unit_conductance, numbering);
}

void number_fields(const Numbering& numbering, HeatModel& model) {
  Table<NodeId, BlockId> blocks;
  for (const NodeId node : numbering.nodes) blocks.push_back(model.blocks[node]);
  model.blocks = std::move(blocks);
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(numbering.nodes.size()));
  for (std::size_t row = 0; row < numbering.nodes.size(); ++row) {
    places.col(static_cast<Eigen::Index>(row)) = model.places.col(numbering.nodes[row].value());
  }
  model.places = std::move(places);
  Eigen::VectorXd capacity = summed(model.capacity, numbering);
  model.initial = mean(model.initial, model.capacity, capacity, numbering);
  model.capacity = std::move(capacity);
  of_rows(model.conductance, numbering).swap(model.conductance);
  if (model.varying) number_properties(numbering, *model.varying);
}

// What lumped blocks store and start at, which is of no single node.
template <int dim>
void set_lumped(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                const std::vector<MeanTemperature>& means, HeatModel& model) {
  for (std::size_t i = 0; i < means.size(); ++i) {
    const LumpedBlock& block = model.lumped->all()[i];
    const Material& material = materials[mesh.bodies[mesh.blocks[block.block].body].material];
    model.initial[block.row.value()] = means[i].mean;
    model.capacity[block.row.value()] = means[i].mass * (*material.specific_heat)(means[i].mean);
    if (model.varying) model.varying->mass[block.row.value()] = means[i].mass;
  }
}

// Of each lumped block, while temperatures are still those of nodes.
template <int dim>
std::vector<MeanTemperature> mean_temperatures(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                               const Numbering& numbering, HeatModel& model) {
  std::vector<MeanTemperature> means;
  for (LumpedBlock& block : model.lumped->all()) {
    const mesh::Block& of = mesh.blocks[block.block];
    means.push_back(mean_temperature(mesh, of, *materials[mesh.bodies[of.body].material].density, model.initial));
    block.row = numbering.rows[of.nodes[0]];
    block.start_spread = means.back().spread;
  }
  return means;
}

}  // namespace

template <int dim>
void share_rows(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                const std::optional<Table<NodeId, NodeId>>& tied, HeatModel& model) {
  SCREE_EXPECT(!tied || !model.varying);
  const Numbering numbering = number_rows(mesh, model, tied);
  std::vector<MeanTemperature> means;
  if (model.lumped) means = mean_temperatures(mesh, materials, numbering, model);
  number_fields(numbering, model);
  number_conditions(numbering, model);
  if (model.lumped) set_lumped(mesh, materials, means, model);
  for (const NodeId node : mesh.nodes.ids()) model.tied_nodes += tied && (*tied)[node] != node ? 1 : 0;
  model.rows = NodeMap(numbering.rows);
}

template void share_rows<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                            const std::optional<Table<NodeId, NodeId>>&, HeatModel&);
template void share_rows<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                            const std::optional<Table<NodeId, NodeId>>&, HeatModel&);

}  // namespace scree::thermal
