#include "thermal/assemble_blocks.h"

#include <algorithm>
#include <numeric>

#include "engine/base/threads.h"
#include "engine/mesh/cells.h"
#include "thermal/repeated_cells.h"
#include "thermal/sparse_sum.h"

namespace scree::thermal {

namespace {

constexpr int rows_in_chunk = 4096;

template <int dim>
bool has_cells(const mesh::BlockMesh<dim>& mesh, BlockId block) {
  return mesh.blocks[block].cells.size() > 0;
}

// Of each node the cells, or in a block without cells the elements, that it belongs to, in their order.
template <int dim>
struct Incidence {
  std::vector<std::uint32_t> begin;  // of each node, and the end
  std::vector<std::uint32_t> of_node;

  Incidence(const mesh::BlockMesh<dim>& mesh, const std::optional<LumpedBlocks>& lumped) : begin(mesh.nodes.size() + 1, 0) {
    for_each_use(mesh, lumped, [&](NodeId node, std::uint32_t) { ++begin[node.index() + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    of_node.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_each_use(mesh, lumped, [&](NodeId node, std::uint32_t piece) { of_node[next[node.index()]++] = piece; });
  }

 private:
  template <class Visit>
  static void for_each_use(const mesh::BlockMesh<dim>& mesh, const std::optional<LumpedBlocks>& lumped, const Visit& visit) {
    for (const BlockId b : mesh.blocks.ids()) {
      if (lumped && lumped->contain(b)) continue;
      const mesh::Block& block = mesh.blocks[b];
      for (const CellId cell : block.cells) {
        const mesh::Cell& corners = mesh.cells[cell];
        for (std::size_t i = 0; i < mesh::corner_count(corners.kind); ++i) {
          visit(corners.nodes[i], static_cast<std::uint32_t>(cell.index()));
        }
      }
      if (block.cells.size() > 0) continue;
      for (const ElementId element : block.elements) {
        for (const NodeId node : mesh.elements[element]) visit(node, static_cast<std::uint32_t>(element.index()));
      }
    }
  }
};

// What conducts and stores: cells and elements, and the conductivity of each block at its constant value, or at 1 W/m/K.
template <int dim>
struct Pieces {
  const mesh::BlockMesh<dim>& mesh;
  Table<BlockId, Tensor<dim>> conductivity;
  SpaceOrder order;
  RepeatedCells<dim> repeated;

  Pieces(const mesh::BlockMesh<dim>& all, const Table<MaterialId, Material>& materials, SpaceOrder space_order)
      : mesh(all), conductivity(conductivities(all, materials)), order(space_order), repeated(all, conductivity, order) {}

  // Calls `use` with what the node has of a cell, and the cell.
  template <class Use>
  void corner(std::uint32_t cell, int node, BlockId block, const Use& use) const {
    const mesh::Cell& corners = mesh.cells[CellId(cell)];
    int at = 0;
    while (corners.nodes[at].value() != node) ++at;
    if (const auto* known = repeated.find(CellId(cell))) {
      use((*known)[at], corners);
    } else {
      use(corner_of_cell<dim>(corners.kind, cell_points(mesh, corners), conductivity[block], at, order), corners);
    }
  }

 private:
  static Table<BlockId, Tensor<dim>> conductivities(const mesh::BlockMesh<dim>& mesh,
                                                    const Table<MaterialId, Material>& materials) {
    Table<BlockId, Tensor<dim>> all;
    all.reserve(mesh.blocks.size());
    for (const mesh::Block& block : mesh.blocks) {
      const Conductivity& conductivity = *materials[mesh.bodies[block.body].material].conductivity;
      all.push_back(conductivity.value.constant().value_or(1) * conductivity_ratios<dim>(conductivity, block));
    }
    return all;
  }
};

// Which of the matrices is put together: K of constant conductivities, U of the others, or B.
enum class Which { constant, unit, shared };

// Of each entry of B: density times specific heat [J/m3/K].
double heat_per_volume(const Material& material, double temperature) {
  return *material.density * (*material.specific_heat)(temperature);
}

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
  RowSum(const Pieces<dim>& pieces, const Incidence<dim>& incidence)
      : pieces_(pieces), incidence_(incidence), slot_(pieces.mesh.nodes.size(), -1) {}

  // Appends the row of a node of the block: `entries` of its corners of cells, times `factor`.
  void append(int node, BlockId block, std::array<double, 8> CornerOfCell::*entries, double factor, Chunk& chunk) {
    row_.clear();
    for (std::uint32_t k = incidence_.begin[node]; k < incidence_.begin[node + 1]; ++k) {
      if (has_cells(pieces_.mesh, block)) {
        pieces_.corner(incidence_.of_node[k], node, block, [&](const CornerOfCell& corner, const mesh::Cell& cell) {
          for (std::size_t i = 0; i < mesh::corner_count(cell.kind); ++i) {
            const double entry = (corner.*entries)[i];
            if (entry != 0) add(cell.nodes[i].value(), entry);
          }
        });
      } else {
        add(pieces_.mesh.elements[ElementId(incidence_.of_node[k])], node, pieces_.conductivity[block]);
      }
    }
    std::sort(row_.begin(), row_.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    for (const Entry& entry : row_) {
      chunk.columns.push_back(entry.column);
      chunk.values.push_back(factor * entry.value);
      slot_[entry.column] = -1;
    }
  }

 private:
  struct Entry {
    int column;
    double value;
  };

  void add(const mesh::Simplex<dim>& nodes, int node, const Tensor<dim>& conductivity) {
    const CornerMatrix<dim> conductance = element_conductance<dim>(corner_points<dim>(pieces_.mesh, nodes), conductivity);
    int corner = 0;
    while (nodes[corner].value() != node) ++corner;
    for (int i = 0; i <= dim; ++i) add(nodes[i].value(), conductance(corner, i));
  }

  void add(int column, double value) {
    int& slot = slot_[column];
    if (slot < 0) {
      slot = static_cast<int>(row_.size());
      row_.push_back({column, 0});
    }
    row_[slot].value += value;
  }

  const Pieces<dim>& pieces_;
  const Incidence<dim>& incidence_;
  std::vector<int> slot_;
  std::vector<Entry> row_;
};

// Each chunk on its own, by all threads.
SparseMatrix joined(const std::vector<Chunk>& chunks, Eigen::Index size) {
  std::vector<int> offset(chunks.size() + 1, 0);
  for (std::size_t c = 0; c < chunks.size(); ++c) offset[c + 1] = offset[c] + static_cast<int>(chunks[c].columns.size());
  SparseMatrix matrix = uninitialised(size, offset.back());
#pragma omp parallel for schedule(static) if (size >= rows_worth_sharing)
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    std::copy(chunks[c].columns.begin(), chunks[c].columns.end(), matrix.innerIndexPtr() + offset[c]);
    std::copy(chunks[c].values.begin(), chunks[c].values.end(), matrix.valuePtr() + offset[c]);
    int* end = matrix.outerIndexPtr() + c * rows_in_chunk + 1;
    for (const int row_end : chunks[c].ends) *end++ = offset[c] + row_end;
  }
  return matrix;
}

// The rows of the nodes that have any in this matrix; the rest are empty.
template <int dim>
SparseMatrix rows_of(const Pieces<dim>& pieces, const Table<MaterialId, Material>& materials, const HeatModel& model,
                     const Incidence<dim>& incidence, Which which) {
  const mesh::BlockMesh<dim>& mesh = pieces.mesh;
  const auto size = static_cast<int>(mesh.nodes.size());
  std::vector<Chunk> chunks(static_cast<std::size_t>((size + rows_in_chunk - 1) / rows_in_chunk));
#pragma omp parallel if (size >= rows_worth_sharing)
  {
    RowSum<dim> sum(pieces, incidence);
#pragma omp for schedule(dynamic)
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      const int first = static_cast<int>(c) * rows_in_chunk;
      for (int node = first; node < std::min(size, first + rows_in_chunk); ++node) {
        const BlockId block = model.blocks[NodeId(static_cast<std::size_t>(node))];
        const Material& material = materials[mesh.bodies[mesh.blocks[block].body].material];
        if (which == Which::shared) {
          sum.append(node, block, &CornerOfCell::shared, heat_per_volume(material, model.initial[node]), chunks[c]);
        } else if (material.conductivity->varies() == (which == Which::unit)) {
          sum.append(node, block, &CornerOfCell::conductance, 1, chunks[c]);
        }
        chunks[c].ends.push_back(static_cast<int>(chunks[c].columns.size()));
      }
    }
  }
  return joined(chunks, size);
}

template <int dim>
void set_capacities(const Pieces<dim>& pieces, const Table<MaterialId, Material>& materials, const Incidence<dim>& incidence,
                    HeatModel& model) {
#pragma omp parallel for schedule(static) if (model.capacity.size() >= rows_worth_sharing)
  for (Eigen::Index row = 0; row < model.capacity.size(); ++row) {
    const auto node = static_cast<int>(row);
    const BlockId block = model.blocks[NodeId(static_cast<std::size_t>(node))];
    const Material& material = materials[pieces.mesh.bodies[pieces.mesh.blocks[block].body].material];
    double volume = 0;
    for (std::uint32_t k = incidence.begin[node]; k < incidence.begin[node + 1]; ++k) {
      if (has_cells(pieces.mesh, block)) {
        pieces.corner(incidence.of_node[k], node, block,
                      [&](const CornerOfCell& corner, const mesh::Cell&) { volume += corner.volume; });
      } else {
        volume += mesh::element_volume(pieces.mesh, ElementId(incidence.of_node[k]));
      }
    }
    const double mass = corner_mass<dim>(volume, *material.density);
    model.capacity[row] = mass * (*material.specific_heat)(model.initial[row]);
    if (model.varying) model.varying->mass[row] = mass;
  }
}

}  // namespace

template <int dim>
SparseMatrix assemble_blocks(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, SpaceOrder order,
                             HeatModel& model) {
  const Incidence<dim> incidence(mesh, model.lumped);
  const Pieces<dim> pieces(mesh, materials, order);
  set_capacities(pieces, materials, incidence, model);
  const bool any_varies = std::any_of(mesh.bodies.begin(), mesh.bodies.end(),
                                      [&](const mesh::Body& body) { return materials[body.material].conductivity->varies(); });
  if (any_varies) model.varying->unit_conductance = rows_of(pieces, materials, model, incidence, Which::unit);
  if (order == SpaceOrder::fourth) model.shared_capacity = rows_of(pieces, materials, model, incidence, Which::shared);
  return rows_of(pieces, materials, model, incidence, Which::constant);
}

template SparseMatrix assemble_blocks<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&, SpaceOrder, HeatModel&);
template SparseMatrix assemble_blocks<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&, SpaceOrder, HeatModel&);

}  // namespace scree::thermal
