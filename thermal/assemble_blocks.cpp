#include "thermal/assemble_blocks.h"

#include <algorithm>

#include "engine/base/chunks.h"
#include "engine/base/threads.h"
#include "engine/mesh/cells.h"
#include "thermal/fastest_cell.h"
#include "thermal/incidence.h"
#include "thermal/repeated_cells.h"
#include "thermal/row_assembly.h"

namespace scree::thermal {

namespace {

template <int dim>
bool has_cells(const mesh::BlockMesh<dim>& mesh, BlockId block) {
  return mesh.blocks[block].cells.size() > 0;
}

// Calls visit(node, piece) for some of the cells of a block, or if it has none for its elements, in their order.
template <int dim, class Visit>
void visit_pieces(const mesh::BlockMesh<dim>& mesh, const mesh::Block& block, std::size_t begin, std::size_t end,
                  const Visit& visit) {
  for (std::size_t i = begin; i < end; ++i) {
    if (block.cells.size() > 0) {
      const mesh::Cell& corners = mesh.cells[block.cells[i]];
      for (std::size_t n = 0; n < mesh::corner_count(corners.kind); ++n) {
        visit(corners.nodes[n].value(), static_cast<std::uint32_t>(block.cells[i].index()));
      }
    } else {
      const ElementId element = block.elements[i];
      for (const NodeId node : mesh.elements[element]) visit(node.value(), static_cast<std::uint32_t>(element.index()));
    }
  }
}

// The pieces that each node belongs to; those of blocks that are lumped have none.
template <int dim>
Incidence pieces_at_nodes(const mesh::BlockMesh<dim>& mesh, const std::optional<LumpedBlocks>& lumped) {
  std::vector<std::size_t> ends{0};  // of the pieces of each block
  for (const BlockId b : mesh.blocks.ids()) {
    const mesh::Block& block = mesh.blocks[b];
    const std::size_t pieces = has_cells(mesh, b) ? block.cells.size() : block.elements.size();
    ends.push_back(ends.back() + (lumped && lumped->contain(b) ? 0 : pieces));
  }
  return Incidence(mesh.nodes.size(), chunk_count(ends.back()), [&](std::size_t part, const auto& visit) {
    const Chunk chunk = chunk_of(ends.back(), part);
    auto block = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), chunk.begin) - ends.begin()) - 1;
    for (std::size_t begin = chunk.begin; begin < chunk.end; ++block) {
      const std::size_t end = std::min(chunk.end, ends[block + 1]);
      visit_pieces(mesh, mesh.blocks[BlockId{block}], begin - ends[block], end - ends[block], visit);
      begin = end;
    }
  });
}

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

// Adds the row of a node of the block, `entries` of its corners of cells, to that of the model.
template <int dim>
void add_row(const Pieces<dim>& pieces, const Incidence& incidence, int node, BlockId block,
             std::array<double, 8> CornerOfCell::*entries, const NodeMap& rows, RowSum& sum) {
  const bool cells = has_cells(pieces.mesh, block);
  for (const std::uint32_t piece : incidence.of(node)) {
    if (cells) {
      pieces.corner(piece, node, block, [&](const CornerOfCell& corner, const mesh::Cell& cell) {
        for (std::size_t i = 0; i < mesh::corner_count(cell.kind); ++i) {
          const double entry = (corner.*entries)[i];
          if (entry != 0) sum.add(rows[cell.nodes[i]].value(), entry);
        }
      });
      continue;
    }
    const mesh::Simplex<dim>& nodes = pieces.mesh.elements[ElementId(piece)];
    const CornerMatrix<dim> conductance =
        element_conductance<dim>(corner_points<dim>(pieces.mesh, nodes), pieces.conductivity[block]);
    int corner = 0;
    while (nodes[corner].value() != node) ++corner;
    for (int i = 0; i <= dim; ++i) sum.add(rows[nodes[i]].value(), conductance(corner, i));
  }
}

// The rows of the nodes that have any in this matrix; the rest are empty.
template <int dim>
class Rows {
 public:
  Rows(const Pieces<dim>& pieces, const Table<MaterialId, Material>& materials, const HeatModel& model,
       const Incidence& incidence, const std::optional<RowNumbering>& numbering)
      : pieces_(pieces),
        materials_(materials),
        model_(model),
        incidence_(incidence),
        numbering_(numbering),
        rows_(numbering ? numbering->rows : identity_) {}

  [[nodiscard]] SparseMatrix of(Which which) const {
    if (!numbering_) {
      return assembled(static_cast<int>(pieces_.mesh.nodes.size()),
                       [&](int node, RowSum& sum) { return add(node, which, sum); });
    }
    const auto add_nodes = [&](int row, RowSum& sum) {
      double factor = 1;
      for (const std::uint32_t node : numbering_->nodes.of(row)) factor = add(static_cast<int>(node), which, sum);
      return factor;
    };
    return assembled(static_cast<int>(numbering_->first.size()), add_nodes, rows_.in_mesh_order());
  }

 private:
  // Returns what the row is to be multiplied by.
  double add(int node, Which which, RowSum& sum) const {
    const BlockId block = model_.blocks[NodeId(static_cast<std::size_t>(node))];
    const Material& material = materials_[pieces_.mesh.bodies[pieces_.mesh.blocks[block].body].material];
    if (which == Which::shared) {
      add_row(pieces_, incidence_, node, block, &CornerOfCell::shared, rows_, sum);
      return heat_per_volume(material, model_.initial[node]);
    }
    if (material.conductivity->varies() == (which == Which::unit)) {
      add_row(pieces_, incidence_, node, block, &CornerOfCell::conductance, rows_, sum);
    }
    return 1;
  }

  const Pieces<dim>& pieces_;
  const Table<MaterialId, Material>& materials_;
  const HeatModel& model_;
  const Incidence& incidence_;
  const std::optional<RowNumbering>& numbering_;
  const NodeMap identity_;
  const NodeMap& rows_;
};

template <int dim>
void set_capacities(const Pieces<dim>& pieces, const Table<MaterialId, Material>& materials, const Incidence& incidence,
                    HeatModel& model) {
#pragma omp parallel for schedule(static) if (model.capacity.size() >= rows_worth_sharing)
  for (Eigen::Index row = 0; row < model.capacity.size(); ++row) {
    const auto node = static_cast<int>(row);
    const BlockId block = model.blocks[NodeId(static_cast<std::size_t>(node))];
    const Material& material = materials[pieces.mesh.bodies[pieces.mesh.blocks[block].body].material];
    double volume = 0;
    for (const std::uint32_t piece : incidence.of(node)) {
      if (has_cells(pieces.mesh, block)) {
        pieces.corner(piece, node, block, [&](const CornerOfCell& corner, const mesh::Cell&) { volume += corner.volume; });
      } else {
        volume += mesh::element_volume(pieces.mesh, ElementId(piece));
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
                             const std::optional<RowNumbering>& numbering, HeatModel& model) {
  const Incidence incidence = pieces_at_nodes(mesh, model.lumped);
  const Pieces<dim> pieces(mesh, materials, order);
  set_capacities(pieces, materials, incidence, model);
  model.fastest_cell = fastest_cell(mesh, materials, pieces.repeated, model);
  const bool any_varies = std::any_of(mesh.bodies.begin(), mesh.bodies.end(),
                                      [&](const mesh::Body& body) { return materials[body.material].conductivity->varies(); });
  const Rows<dim> rows(pieces, materials, model, incidence, numbering);
  if (any_varies) rows.of(Which::unit).swap(model.varying->unit_conductance);
  if (order == SpaceOrder::fourth) rows.of(Which::shared).swap(model.shared_capacity.emplace());
  return rows.of(Which::constant);
}

template SparseMatrix assemble_blocks<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&, SpaceOrder,
                                         const std::optional<RowNumbering>&, HeatModel&);
template SparseMatrix assemble_blocks<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&, SpaceOrder,
                                         const std::optional<RowNumbering>&, HeatModel&);

}  // namespace scree::thermal
