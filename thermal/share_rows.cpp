#include "thermal/share_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"

namespace scree::thermal {

namespace {

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

Eigen::VectorXd of_rows(const Eigen::VectorXd& of_nodes, const RowNumbering& numbering) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(numbering.first.size()));
  Eigen::Index row = 0;
  for (const NodeId node : numbering.first) values[row++] = of_nodes[node.value()];
  return values;
}

Eigen::VectorXd summed(const Eigen::VectorXd& of_nodes, const RowNumbering& numbering) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbering.first.size()));
  for (const NodeId node : numbering.rows.ids()) sums[numbering.rows[node].value()] += of_nodes[node.value()];
  return sums;
}

// The mean by capacity of each row's nodes, as a difference to the first of them, so that equal temperatures have it to the
// bit.
Eigen::VectorXd mean(const Eigen::VectorXd& of_nodes, const Eigen::VectorXd& capacity, const Eigen::VectorXd& row_capacity,
                     const RowNumbering& numbering) {
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(of_nodes.size());
  for (const NodeId node : numbering.rows.ids()) {
    const NodeId first = numbering.first[numbering.rows[node].index()];
    difference[node.value()] = capacity[node.value()] * (of_nodes[node.value()] - of_nodes[first.value()]);
  }
  const Eigen::VectorXd sums = summed(difference, numbering);
  Eigen::VectorXd means = of_rows(of_nodes, numbering);
  for (Eigen::Index row = 0; row < means.size(); ++row) {
    if (sums[row] != 0) means[row] += sums[row] / row_capacity[row];
  }
  return means;
}

// A node's entry becomes its row's; equal ones are added up unless a function makes them differ from place to place.
NodeShares of_rows(const NodeShares& on, const RowNumbering& numbering, bool by_place) {
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

void number_conditions(const RowNumbering& numbering, HeatModel& model) {
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

void number_properties(const RowNumbering& numbering, VaryingProperties& varying) {
  Table<NodeId, int> material;
  for (const NodeId node : numbering.first) material.push_back(varying.material[node]);
  varying.material = std::move(material);
  varying.mass = of_rows(varying.mass, numbering);
}

void number_fields(const RowNumbering& numbering, HeatModel& model) {
  Table<NodeId, BlockId> blocks;
  for (const NodeId node : numbering.first) blocks.push_back(model.blocks[node]);
  model.blocks = std::move(blocks);
  Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(numbering.first.size()));
  for (std::size_t row = 0; row < numbering.first.size(); ++row) {
    places.col(static_cast<Eigen::Index>(row)) = model.places.col(numbering.first[row].value());
  }
  model.places = std::move(places);
  Eigen::VectorXd capacity = summed(model.capacity, numbering);
  model.initial = mean(model.initial, model.capacity, capacity, numbering);
  model.capacity = std::move(capacity);
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
                                               const RowNumbering& numbering, HeatModel& model) {
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
void share_rows(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const RowNumbering& numbering,
                HeatModel& model) {
  std::vector<MeanTemperature> means;
  if (model.lumped) means = mean_temperatures(mesh, materials, numbering, model);
  number_fields(numbering, model);
  number_conditions(numbering, model);
  if (model.lumped) set_lumped(mesh, materials, means, model);
  model.rows = numbering.rows;
}

template void share_rows<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&, const RowNumbering&, HeatModel&);
template void share_rows<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&, const RowNumbering&, HeatModel&);

}  // namespace scree::thermal
