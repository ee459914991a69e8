#include "thermal/assemble_blocks.h"

#include <algorithm>
#include <numeric>

#include "engine/base/threads.h"
#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"

namespace scree::thermal {

namespace {

constexpr int rows_in_chunk = 4096;

template <int dim>
struct WeightedSimplex {
  mesh::Simplex<dim> nodes;
  double weight;
};

// Every simplex that conducts and stores, and of each node those it belongs to, in their order.
template <int dim>
struct Incidence {
  std::vector<WeightedSimplex<dim>> simplices;
  std::vector<std::uint32_t> begin;  // of each node, and the end
  std::vector<std::uint32_t> of_node;

  explicit Incidence(const mesh::BlockMesh<dim>& mesh) : begin(mesh.nodes.size() + 1, 0) {
    simplices.reserve(mesh.cells.empty() ? mesh.elements.size() : 2 * mesh.elements.size());
    for (const mesh::Block& block : mesh.blocks) {
      mesh::for_each_simplex(mesh, block, [&](const mesh::Simplex<dim>& nodes, double weight) {
        simplices.push_back({nodes, weight});
      });
    }
    for (const auto& simplex : simplices) {
      for (const NodeId node : simplex.nodes) ++begin[node.index() + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    of_node.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t s = 0; s < simplices.size(); ++s) {
      for (const NodeId node : simplices[s].nodes) of_node[next[node.index()]++] = s;
    }
  }
};

// A run of rows as it grows.
struct Chunk {
  std::vector<int> columns;
  std::vector<double> values;
  std::vector<int> ends;  // of each row, in this chunk
};

// One thread's tools: the row that is being summed, and where each column of it stands.
template <int dim>
class RowSum {
 public:
  RowSum(const mesh::BlockMesh<dim>& mesh, const Incidence<dim>& incidence, std::size_t nodes)
      : mesh_(mesh), incidence_(incidence), slot_(nodes, -1) {}

  // Appends the row of a node whose block conducts with this tensor.
  void append(int node, const Tensor<dim>& conductivity, Chunk& chunk) {
    row_.clear();
    for (std::uint32_t k = incidence_.begin[node]; k < incidence_.begin[node + 1]; ++k) {
      const WeightedSimplex<dim>& simplex = incidence_.simplices[incidence_.of_node[k]];
      const CornerMatrix<dim> conductance =
          simplex.weight * element_conductance<dim>(corner_points<dim>(mesh_, simplex.nodes), conductivity);
      int corner = 0;
      while (simplex.nodes[corner].value() != node) ++corner;
      for (int i = 0; i <= dim; ++i) add(simplex.nodes[i].value(), conductance(corner, i));
    }
    std::sort(row_.begin(), row_.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    for (const Entry& entry : row_) {
      chunk.columns.push_back(entry.column);
      chunk.values.push_back(entry.value);
      slot_[entry.column] = -1;
    }
  }

 private:
  struct Entry {
    int column;
    double value;
  };

  void add(int column, double value) {
    int& slot = slot_[column];
    if (slot < 0) {
      slot = static_cast<int>(row_.size());
      row_.push_back({column, 0});
    }
    row_[slot].value += value;
  }

  const mesh::BlockMesh<dim>& mesh_;
  const Incidence<dim>& incidence_;
  std::vector<int> slot_;
  std::vector<Entry> row_;
};

SparseMatrix joined(const std::vector<Chunk>& chunks, Eigen::Index size) {
  SparseMatrix matrix(size, size);
  std::size_t entries = 0;
  for (const Chunk& chunk : chunks) entries += chunk.columns.size();
  matrix.resizeNonZeros(static_cast<Eigen::Index>(entries));
  int offset = 0;
  Eigen::Index row = 0;
  for (const Chunk& chunk : chunks) {
    std::copy(chunk.columns.begin(), chunk.columns.end(), matrix.innerIndexPtr() + offset);
    std::copy(chunk.values.begin(), chunk.values.end(), matrix.valuePtr() + offset);
    for (const int end : chunk.ends) matrix.outerIndexPtr()[++row] = offset + end;
    offset += static_cast<int>(chunk.columns.size());
  }
  return matrix;
}

// The rows of the nodes whose block's conductivity varies, or of the others; the rest are empty.
template <int dim>
SparseMatrix rows_of(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const HeatModel& model,
                     const Incidence<dim>& incidence, bool varying) {
  const auto size = static_cast<int>(mesh.nodes.size());
  std::vector<Chunk> chunks(static_cast<std::size_t>((size + rows_in_chunk - 1) / rows_in_chunk));
#pragma omp parallel if (size >= rows_worth_sharing)
  {
    RowSum<dim> sum(mesh, incidence, mesh.nodes.size());
#pragma omp for schedule(dynamic)
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      const int first = static_cast<int>(c) * rows_in_chunk;
      for (int node = first; node < std::min(size, first + rows_in_chunk); ++node) {
        const mesh::Block& block = mesh.blocks[model.blocks[NodeId(static_cast<std::size_t>(node))]];
        const Conductivity& conductivity = *materials[mesh.bodies[block.body].material].conductivity;
        if (conductivity.varies() == varying) {
          const double value = conductivity.value.constant().value_or(1);
          sum.append(node, value * conductivity_ratios<dim>(conductivity, block), chunks[c]);
        }
        chunks[c].ends.push_back(static_cast<int>(chunks[c].columns.size()));
      }
    }
  }
  return joined(chunks, size);
}

template <int dim>
void set_capacities(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                    const Incidence<dim>& incidence, HeatModel& model) {
#pragma omp parallel for schedule(static) if (model.capacity.size() >= rows_worth_sharing)
  for (Eigen::Index node = 0; node < model.capacity.size(); ++node) {
    const mesh::Block& block = mesh.blocks[model.blocks[NodeId(static_cast<std::size_t>(node))]];
    const Material& material = materials[mesh.bodies[block.body].material];
    double mass = 0;
    for (std::uint32_t k = incidence.begin[node]; k < incidence.begin[node + 1]; ++k) {
      const WeightedSimplex<dim>& simplex = incidence.simplices[incidence.of_node[k]];
      mass += simplex.weight * corner_mass<dim>(mesh::simplex_volume<dim>(mesh, simplex.nodes), *material.density);
    }
    model.capacity[node] = mass * (*material.specific_heat)(model.initial[node]);
    if (model.varying) model.varying->mass[node] = mass;
  }
}

}  // namespace

template <int dim>
SparseMatrix assemble_blocks(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, HeatModel& model) {
  const Incidence<dim> incidence(mesh);
  set_capacities(mesh, materials, incidence, model);
  const bool any_varies = std::any_of(mesh.bodies.begin(), mesh.bodies.end(),
                                      [&](const mesh::Body& body) { return materials[body.material].conductivity->varies(); });
  if (any_varies) model.varying->unit_conductance = rows_of(mesh, materials, model, incidence, true);
  return rows_of(mesh, materials, model, incidence, false);
}

template SparseMatrix assemble_blocks<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&, HeatModel&);
template SparseMatrix assemble_blocks<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&, HeatModel&);

}  // namespace scree::thermal
