// Writes a step's flows into the ledger.
#pragma once

#include "thermal/fourth_order.h"
#include "thermal/heat_balance.h"
#include "thermal/heat_run.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

class Bookkeeper {
 public:
  explicit Bookkeeper(const HeatModel& model, Sums sums = Sums::extended);  // refers to it

  // A ledger in which nothing has flowed but what the holds need to bring about `temperature` at the start.
  [[nodiscard]] Ledger open(const Eigen::VectorXd& temperature) const;

  // What the holds need to bring fixed nodes from one temperature to another at once.
  void book_jump(const Eigen::VectorXd& before, const Eigen::VectorXd& after, Ledger& ledger) const;

  // A step of this length from `before`.
  void book(const Step& step, const Eigen::VectorXd& before, double length, Ledger& ledger);

 private:
  // Into the fixed nodes, one entry each [J].
  void give(const Eigen::VectorXd& held, Ledger& ledger) const;
  [[nodiscard]] Eigen::VectorXd stored_in_fixed(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;

  const HeatModel& model_;
  Drives drives_;
  HeatBalance balance_;
  std::optional<HeldShares> shares_;  // in fourth order
};

}  // namespace scree::thermal
