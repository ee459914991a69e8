#include <algorithm>
#include <cmath>
#include <numeric>

#include "thermal/fourth_order.h"
#include "thermal/heat_run.h"
#include "thermal/kirchhoff_matrix.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

double Ledger::residual() const {
  double in = start_jump;
  in = std::accumulate(by_boundary.begin(), by_boundary.end(), in);
  in = std::accumulate(by_applied.begin(), by_applied.end(), in);
  in = std::accumulate(by_surroundings.begin(), by_surroundings.end(), in);
  return std::abs(stored - in);
}

double Ledger::relative_residual() const {
  return turnover > 0 ? residual() / turnover : 0;
}

std::vector<NodeId> ledger_nodes(const HeatModel& model) {
  std::vector<NodeId> nodes = model.fixed_nodes;
  const auto add_joined = [&](const SparseMatrix& matrix) {
    const std::vector<NodeId> first = nodes;
    for (const NodeId node : first) {
      for (SparseMatrix::InnerIterator entry(matrix, node.value()); entry; ++entry) {
        nodes.emplace_back(static_cast<std::size_t>(entry.row()));
      }
    }
  };
  if (model.shared_capacity) {
    const HeldShares shares(model);
    nodes.insert(nodes.end(), shares.givers().begin(), shares.givers().end());
  }
  add_joined(model.conductance);
  if (!is_symmetric(model)) add_joined(model.varying->unit_conductance);
  for (const Exchange& exchange : model.exchanges)
    nodes.insert(nodes.end(), exchange.on.nodes.begin(), exchange.on.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace scree::thermal
