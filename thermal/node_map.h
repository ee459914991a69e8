// Which row of the heat model stands for a node of the mesh: its own, unless the node's block is lumped or the node is tied to
// others (tied_nodes.h): then they share one row.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "engine/base/ids.h"

namespace scree::thermal {

class NodeMap {
 public:
  NodeMap() = default;  // every node has its own row
  NodeMap(Table<NodeId, NodeId> rows, std::vector<int> in_mesh_order)
      : rows_(std::move(rows)), in_mesh_order_(std::move(in_mesh_order)) {}

  [[nodiscard]] bool is_identity() const { return rows_.empty(); }
  [[nodiscard]] std::size_t nodes() const { return rows_.size(); }   // of the mesh; 0 for the identity
  [[nodiscard]] IdRange<NodeId> ids() const { return rows_.ids(); }  // likewise
  NodeId operator[](NodeId node) const { return is_identity() ? node : rows_[node]; }

  // The rows in the order of their first nodes, in which what they are made of is at hand; empty for the identity.
  [[nodiscard]] std::span<const int> in_mesh_order() const { return in_mesh_order_; }

  // One value per row to one per node of the mesh.
  [[nodiscard]] Eigen::VectorXd to_nodes(const Eigen::VectorXd& of_rows) const {
    if (is_identity()) return of_rows;
    Eigen::VectorXd values(static_cast<Eigen::Index>(rows_.size()));
    for (const NodeId node : rows_.ids()) values[node.value()] = of_rows[rows_[node].value()];
    return values;
  }

 private:
  Table<NodeId, NodeId> rows_;
  std::vector<int> in_mesh_order_;
};

}  // namespace scree::thermal
