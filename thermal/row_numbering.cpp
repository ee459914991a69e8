#include "thermal/row_numbering.h"

#include <utility>

#include "thermal/row_order.h"

namespace scree::thermal {

template <int dim>
std::optional<RowNumbering> number_rows(const mesh::BlockMesh<dim>& mesh, const HeatModel& model,
                                        const std::optional<Table<NodeId, NodeId>>& tied) {
  const bool in_order = is_worth_ordering(mesh);
  if (!model.lumped && !tied && !in_order) return std::nullopt;
  Table<NodeId, NodeId> first_of(mesh.nodes.size());  // of those that share a row
  std::vector<NodeId> first;
  for (const BlockId b : mesh.blocks.ids()) {
    const bool one_row = model.lumped && model.lumped->contain(b);
    for (const NodeId node : mesh.blocks[b].nodes) {
      first_of[node] = one_row ? mesh.blocks[b].nodes[0] : tied ? (*tied)[node] : node;
      if (first_of[node] == node) first.push_back(node);
    }
  }
  const std::vector<NodeId> in_mesh_order = first;
  if (in_order) first = in_space_order(in_mesh_order, model.blocks, model.places);
  Table<NodeId, NodeId> rows(mesh.nodes.size());
  for (std::size_t row = 0; row < first.size(); ++row) rows[first[row]] = NodeId(row);
  for (const NodeId node : mesh.nodes.ids()) rows[node] = rows[first_of[node]];
  Incidence nodes =
      incidence_of(first.size(), rows.size(), [&](std::size_t node, const auto& visit) { visit(rows[NodeId{node}].value()); });
  std::vector<int> order;
  order.reserve(first.size());
  for (const NodeId node : in_mesh_order) order.push_back(rows[node].value());
  return RowNumbering{NodeMap(std::move(rows), std::move(order)), std::move(first), std::move(nodes)};
}

template std::optional<RowNumbering> number_rows<2>(const mesh::BlockMesh<2>&, const HeatModel&,
                                                    const std::optional<Table<NodeId, NodeId>>&);
template std::optional<RowNumbering> number_rows<3>(const mesh::BlockMesh<3>&, const HeatModel&,
                                                    const std::optional<Table<NodeId, NodeId>>&);

}  // namespace scree::thermal
