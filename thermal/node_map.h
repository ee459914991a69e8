// Which row of the heat model stands for a node of the mesh: its own, unless the node's block is lumped or the node is tied to
// others (tied_nodes.h): then they share one row.
#pragma once

#include <utility>

#include <Eigen/Core>

#include "engine/base/ids.h"

namespace scree::thermal {

class NodeMap {
 public:
  NodeMap() = default;  // every node has its own row
  explicit NodeMap(Table<NodeId, NodeId> rows) : rows_(std::move(rows)) {}

  [[nodiscard]] bool is_identity() const { return rows_.empty(); }
  [[nodiscard]] std::size_t nodes() const { return rows_.size(); }  // of the mesh; 0 for the identity
  NodeId operator[](NodeId node) const { return is_identity() ? node : rows_[node]; }

  // One value per row to one per node of the mesh.
  [[nodiscard]] Eigen::VectorXd to_nodes(const Eigen::VectorXd& of_rows) const {
    if (is_identity()) return of_rows;
    Eigen::VectorXd values(static_cast<Eigen::Index>(rows_.size()));
    for (const NodeId node : rows_.ids()) values[node.value()] = of_rows[rows_[node].value()];
    return values;
  }

 private:
  Table<NodeId, NodeId> rows_;
};

}  // namespace scree::thermal
