#include "thermal/bookkeeper.h"

#include <cmath>

namespace scree::thermal {

namespace {

// Adds what flowed by each name, and how much that is.
void enter(const std::vector<double>& heat, std::vector<double>& entries, double& turnover) {
  for (std::size_t i = 0; i < heat.size(); ++i) {
    entries[i] += heat[i];
    turnover += std::abs(heat[i]);
  }
}

}  // namespace

Bookkeeper::Bookkeeper(const HeatModel& model, Sums sums) : model_(model), drives_(model), balance_(model, sums) {}

Ledger Bookkeeper::open(const Eigen::VectorXd& temperature) const {
  Ledger ledger;
  ledger.by_boundary.assign(model_.holds.size(), 0.0);
  ledger.by_applied.assign(model_.loads.size(), 0.0);
  ledger.by_surroundings.assign(model_.exchanges.size(), 0.0);
  const Eigen::VectorXd stored = balance_.stored(model_.initial, temperature);
  for (const NodeId node : model_.fixed_nodes) {
    ledger.start_jump += stored[node.value()];
    ledger.turnover += std::abs(stored[node.value()]);
  }
  ledger.stored = stored.sum();
  return ledger;
}

void Bookkeeper::book(const Step& step, const Eigen::VectorXd& before, double length, Ledger& ledger) {
  std::vector<double> held(model_.holds.size(), 0.0);
  std::vector<double> applied(model_.loads.size(), 0.0);
  std::vector<double> exchanged(model_.exchanges.size(), 0.0);
  const Eigen::VectorXd after = before + step.change;
  const Eigen::VectorXd stored = balance_.stored(before, after);
  for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
    held[model_.fixed_hold[i]] += stored[model_.fixed_nodes[i].value()];
  }
  for (const Stage& stage : step.stages) {
    const double duration = stage.weight * length;
    const Drive& drive = drives_.at(stage.time);
    const Eigen::VectorXd heating = balance_.heating(stage.temperature, drive);
    for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
      held[model_.fixed_hold[i]] -= duration * heating[model_.fixed_nodes[i].value()];
    }
    for (std::size_t l = 0; l < applied.size(); ++l) applied[l] += duration * drive.by_load[l];
    for (std::size_t e = 0; e < exchanged.size(); ++e) {
      exchanged[e] += duration * balance_.exchanged(e, stage.temperature, drive);
    }
  }
  enter(held, ledger.by_boundary, ledger.turnover);
  enter(applied, ledger.by_applied, ledger.turnover);
  enter(exchanged, ledger.by_surroundings, ledger.turnover);
  ledger.stored = balance_.stored(model_.initial, after).sum();
}

}  // namespace scree::thermal
