// Steady temperatures straight from K, for tests that hold nodes which no box of space holds.
#pragma once

#include <map>
#include <stdexcept>

#include <Eigen/SparseCholesky>

#include "thermal/heat_model.h"

namespace scree::thermal::test {

using Held = std::map<NodeId, double>;  // [K]

// K T = load [W] at every node that is not held. Throws for a K that is not positive definite there.
inline Eigen::VectorXd steady(const SparseMatrix& conductance, const Held& held, const std::map<NodeId, double>& load = {}) {
  const Eigen::Index size = conductance.rows();
  std::vector<Eigen::Index> unknowns(static_cast<std::size_t>(size), -1);
  Eigen::VectorXd temperature = Eigen::VectorXd::Zero(size);
  for (const auto& [node, value] : held) temperature[node.value()] = value;
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!held.contains(NodeId{static_cast<std::size_t>(i)})) unknowns[static_cast<std::size_t>(i)] = count++;
  }
  const Eigen::VectorXd leaving = conductance * temperature;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Index row = unknowns[static_cast<std::size_t>(i)];
    if (row >= 0) right[row] = -leaving[i];
    for (SparseMatrix::InnerIterator entry(conductance, i); entry; ++entry) {
      const Eigen::Index column = unknowns[static_cast<std::size_t>(entry.row())];
      if (row >= 0 && column >= 0) entries.emplace_back(column, row, entry.value());
    }
  }
  for (const auto& [node, flow] : load) right[unknowns[node.index()]] += flow;
  SparseMatrix free(count, count);
  free.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<SparseMatrix> solver(free);
  if (solver.info() != Eigen::Success) throw std::runtime_error("K is not positive definite");
  const Eigen::VectorXd solution = solver.solve(right);
  for (Eigen::Index i = 0; i < size; ++i) {
    if (unknowns[static_cast<std::size_t>(i)] >= 0) temperature[i] = solution[unknowns[static_cast<std::size_t>(i)]];
  }
  return temperature;
}

// The same for the nodes of the mesh, some of which may share a row of the model.
inline Eigen::VectorXd steady(const HeatModel& model, const Held& held, const std::map<NodeId, double>& load = {}) {
  Held held_rows;
  for (const auto& [node, value] : held) held_rows[model.rows[node]] = value;
  std::map<NodeId, double> load_rows;
  for (const auto& [node, flow] : load) load_rows[model.rows[node]] += flow;
  return model.rows.to_nodes(steady(model.conductance, held_rows, load_rows));
}

}  // namespace scree::thermal::test
