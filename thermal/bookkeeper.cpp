#include "thermal/bookkeeper.h"

#include <cmath>

namespace scree::thermal {

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

void Bookkeeper::book_jump(const Eigen::VectorXd& before, const Eigen::VectorXd& after, Ledger& ledger) const {
  give(stored_in_fixed(before, after), ledger);
  ledger.stored = balance_.stored_in_all(model_.initial, after);
}

// Heat that comes in here and leaves there under one name flows all the same: the turnover counts each node by itself.
void Bookkeeper::book(const Step& step, const Eigen::VectorXd& before, double length, Ledger& ledger) {
  const Eigen::VectorXd after = before + step.change;
  Eigen::VectorXd held = stored_in_fixed(before, after);
  for (const Stage& stage : step.stages) {
    const double duration = stage.weight * length;
    const Drive& drive = drives_.at(stage.time);
    std::optional<TangentPoint> at;
    if (stage.tangent) at.emplace(TangentPoint{before, drives_.at(*stage.tangent)});
    const TangentPoint* tangent = at ? &*at : nullptr;
    held -= duration * balance_.heating_at(model_.fixed_nodes, stage.temperature, drive, tangent);
    if (shares_) held -= duration * shares_->shares(balance_, stage.temperature, drive);
    for (std::size_t l = 0; l < model_.loads.size(); ++l) ledger.by_applied[l] += duration * drive.by_load[l];
    ledger.turnover += duration * drive.load_sizes.sum();
    for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
      const auto [heat, size] = balance_.exchanged(e, stage.temperature, drive, tangent);
      ledger.by_surroundings[e] += duration * heat;
      ledger.turnover += duration * size;
    }
  }
  give(held, ledger);
  ledger.stored = balance_.stored_in_all(model_.initial, after);
}

Eigen::VectorXd Bookkeeper::stored_in_fixed(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
  Eigen::VectorXd stored(static_cast<Eigen::Index>(model_.fixed_nodes.size()));
  for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
    stored[static_cast<Eigen::Index>(i)] = balance_.stored_at(model_.fixed_nodes[i], before, after);
  }
  return stored;
}

void Bookkeeper::give(const Eigen::VectorXd& held, Ledger& ledger) const {
  for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
    const double heat = held[static_cast<Eigen::Index>(i)];
    ledger.by_boundary[model_.fixed_hold[i]] += heat;
    ledger.turnover += std::abs(heat);
  }
}

}  // namespace scree::thermal
