// Which nodes stand for which row of the model, where a row is not simply a node.
#pragma once

#include <optional>
#include <vector>

#include "thermal/heat_model.h"
#include "thermal/incidence.h"
#include "thermal/node_map.h"

namespace scree::thermal {

struct RowNumbering {
  NodeMap rows;
  std::vector<NodeId> first;  // node of each row
  Incidence nodes;            // of each row, ascending
};

// One row for all nodes of a lumped block, one for the nodes that are one (`tied`, tied_nodes.h), in the order of space where
// that pays (row_order.h). Nothing if every node has its own row, in the order of the nodes.
template <int dim>
std::optional<RowNumbering> number_rows(const mesh::BlockMesh<dim>& mesh, const HeatModel& model,
                                        const std::optional<Table<NodeId, NodeId>>& tied);

}  // namespace scree::thermal
