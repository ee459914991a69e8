#include "thermal/lump.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"

namespace scree::thermal {

namespace {

// The row of each node, and the first node of each row.
struct Numbering {
  Table<NodeId, NodeId> rows;
  std::vector<NodeId> nodes;
};

template <int dim>
Numbering number_rows(const mesh::BlockMesh<dim>& mesh, const LumpedBlocks& lumped) {
  Numbering numbering{Table<NodeId, NodeId>(mesh.nodes.size()), {}};
  for (const BlockId b : mesh.blocks.ids()) {
    bool first = true;
    for (const NodeId node : mesh.blocks[b].nodes) {
      if (first || !lumped.contain(b)) numbering.nodes.push_back(node);
      numbering.rows[node] = NodeId{numbering.nodes.size() - 1};
      first = false;
    }
  }
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

// Columns of nodes that are not the first of their row are empty, as are those of lumped blocks.
SparseMatrix of_rows(const SparseMatrix& of_nodes, const Numbering& numbering) {
  const auto size = static_cast<Eigen::Index>(numbering.nodes.size());
  SparseMatrix matrix(size, size);
  matrix.reserve(of_nodes.nonZeros());
  for (Eigen::Index column = 0; column < size; ++column) {
    matrix.startVec(column);
    for (SparseMatrix::InnerIterator entry(of_nodes, numbering.nodes[static_cast<std::size_t>(column)].value()); entry;
         ++entry) {
      matrix.insertBack(numbering.rows[NodeId(static_cast<std::size_t>(entry.row()))].value(), column) = entry.value();
    }
  }
  matrix.finalize();
  return matrix;
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
  std::vector<NodeId> fixed;
  std::vector<int> hold;
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    const NodeId row = numbering.rows[model.fixed_nodes[i]];
    if (!fixed.empty() && fixed.back() == row) continue;
    fixed.push_back(row);
    hold.push_back(model.fixed_hold[i]);
  }
  model.fixed_nodes = std::move(fixed);
  model.fixed_hold = std::move(hold);
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
  model.initial = of_rows(model.initial, numbering);
  model.capacity = of_rows(model.capacity, numbering);
  model.conductance = of_rows(model.conductance, numbering);
  if (model.varying) number_properties(numbering, *model.varying);
}

}  // namespace

template <int dim>
void lump(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, HeatModel& model) {
  const Numbering numbering = number_rows(mesh, *model.lumped);
  std::vector<MeanTemperature> means;
  for (LumpedBlock& block : model.lumped->all()) {
    const mesh::Block& of = mesh.blocks[block.block];
    means.push_back(mean_temperature(mesh, of, *materials[mesh.bodies[of.body].material].density, model.initial));
    block.row = numbering.rows[of.nodes[0]];
    block.start_spread = means.back().spread;
  }
  number_fields(numbering, model);
  number_conditions(numbering, model);
  for (std::size_t i = 0; i < means.size(); ++i) {
    const LumpedBlock& block = model.lumped->all()[i];
    const Material& material = materials[mesh.bodies[mesh.blocks[block.block].body].material];
    model.initial[block.row.value()] = means[i].mean;
    model.capacity[block.row.value()] = means[i].mass * (*material.specific_heat)(means[i].mean);
    if (model.varying) model.varying->mass[block.row.value()] = means[i].mass;
  }
  model.rows = NodeMap(numbering.rows);
}

template void lump<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&, HeatModel&);
template void lump<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&, HeatModel&);

}  // namespace scree::thermal
