// What an implicit step's estimate misses where c or k bends on the step's way, as at the corners of a freezing curve.
//
// The companion of sdirk2.h takes what flows for a parabola through the step's start and its two stages. H may go along one; T
// and Phi, which are bent functions of it, then do not, and with w the weights of the parabola's quadrature the companion's
// heat is off by
//   -h (J D_T + U D_Phi),   D_x = sum_i w_i x(t_i) - integral of x over the step/h,
// U and Phi where k depends on temperature (heat_balance.h), J what else a node loses by being warmer. The integrals are by
// looks at the parabola of H, and at held temperatures at their own times.
#pragma once

#include <array>
#include <optional>

#include "thermal/heat_balance.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

class BentPath {
 public:
  BentPath(const HeatModel& model, const HeatBalance& balance, Drives& drives);  // refers to all

  // Heat that each node gets too much in a step of `length` [s] from `from` with these stages [J]; `loss` to surroundings
  // [W/K]. Nothing if neither c nor k bends.
  [[nodiscard]] std::optional<Eigen::VectorXd> missed(const Instant& from, double length, const std::array<Stage, 2>& stages,
                                                      const Eigen::VectorXd& loss);

 private:
  [[nodiscard]] bool bends(const Instant& from, const std::array<Stage, 2>& stages) const;

  const HeatModel& model_;
  const HeatBalance& balance_;
  Drives& drives_;
  bool held_conductivity_bends_;
};

}  // namespace scree::thermal
