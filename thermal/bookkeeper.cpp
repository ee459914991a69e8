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

Bookkeeper::Bookkeeper(const HeatModel& model, Sums sums) : model_(model), drives_(model), balance_(model, sums) {
  if (model.shared_capacity) shares_.emplace(model);
}

Ledger Bookkeeper::open(const Eigen::VectorXd& temperature) const {
  Ledger ledger;
  ledger.by_boundary.assign(model_.holds.size(), 0.0);
  ledger.by_applied.assign(model_.loads.size(), 0.0);
  ledger.by_surroundings.assign(model_.exchanges.size(), 0.0);
  for (const NodeId node : model_.blocks.ids()) {  // in fourth order the jump reaches nodes beside the fixed ones
    const double stored = balance_.stored_at(node, model_.initial, temperature);
    ledger.start_jump += stored;
    ledger.turnover += std::abs(stored);
  }
  ledger.stored = balance_.stored_in_all(model_.initial, temperature);
  return ledger;
}

void Bookkeeper::book(const Step& step, const Eigen::VectorXd& before, double length, Ledger& ledger) {
  std::vector<double> held(model_.holds.size(), 0.0);
  std::vector<double> applied(model_.loads.size(), 0.0);
  std::vector<double> exchanged(model_.exchanges.size(), 0.0);
  const Eigen::VectorXd after = before + step.change;
  for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
    held[model_.fixed_hold[i]] += balance_.stored_at(model_.fixed_nodes[i], before, after);
  }
  for (const Stage& stage : step.stages) {
    const double duration = stage.weight * length;
    const Drive& drive = drives_.at(stage.time);
    Eigen::VectorXd heating = balance_.heating_at(model_.fixed_nodes, stage.temperature, drive);
    if (shares_) heating += shares_->shares(balance_, stage.temperature, drive);
    for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
      held[model_.fixed_hold[i]] -= duration * heating[static_cast<Eigen::Index>(i)];
    }
    for (std::size_t l = 0; l < applied.size(); ++l) applied[l] += duration * drive.by_load[l];
    for (std::size_t e = 0; e < exchanged.size(); ++e) {
      exchanged[e] += duration * balance_.exchanged(e, stage.temperature, drive);
    }
  }
  enter(held, ledger.by_boundary, ledger.turnover);
  enter(applied, ledger.by_applied, ledger.turnover);
  enter(exchanged, ledger.by_surroundings, ledger.turnover);
  ledger.stored = balance_.stored_in_all(model_.initial, after);
}

}  // namespace scree::thermal
