// How much warmer heat makes a node within a stabilised step, where c depends on temperature.
//
// With D the heat over the step's first capacity [K], H(T) - H(T0) = C(T0) D gives to second order
//   T - T0 = x(D) = D - q D^2/2,  q = (dC/dT)/C at T0.
// Where it is known about how far a node will get in the step, q is that of the parabola which goes through the enthalpy there:
// behind a kink of c, as at a table's row, the one of the start leads astray, by some tenths of a millikelvin. Of these the
// flow through stiff joints, and the estimate with it, makes tens of millikelvin.
//
// The slope of x is 1 - q D. It bends by `most_bend` at most, and is straight from there on: then the step's operator is
// J diag(x'), whose eigenvalues are at most 1 + most_bend times those of J. What is left of C(T) is the step's own error.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/base/phases.h"
#include "thermal/heat_balance.h"

namespace scree::thermal {

class BentStorage {
 public:
  // Of rock between 25 and 100 C c rises by a tenth: steps of 20 K follow it.
  static constexpr double most_bend = 1.0 / 32;

  explicit BentStorage(const HeatModel& model)
      : model_(model),
        bends_(model.varying && std::any_of(model.varying->specific_heat.begin(), model.varying->specific_heat.end(),
                                            [](const Curve& c) { return !c.constant(); })) {}

  // Whether any c depends on temperature; else T - T0 is D, and nothing else may be called.
  [[nodiscard]] explicit operator bool() const { return bends_; }

  // At the temperatures T0, with these capacities [J/K]; `expected`: temperatures at the step's end, about [K], or of no size.
  // Fixed nodes are as warm as they are held.
  void fit(const HeatBalance& balance, const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity,
           const Eigen::VectorXd& expected) {
    slope_ = capacity_slope_at(model_, temperature);
    if (expected.size() > 0) go_through(balance, temperature, capacity, expected);
    for (const NodeId node : model_.fixed_nodes) slope_[node.value()] = 0;
  }

  // x of D in one row [K].
  [[nodiscard]] static double rise(double slope, double heat) {
    const double bend = std::clamp(slope * heat, -most_bend, most_bend);
    return bend == slope * heat ? heat - 0.5 * bend * heat : heat - bend * (heat - 0.5 * bend / slope);
  }

  // How much warmer nodes are than T0 + x(D) on their way through a step, in the mean, beside a third of what they are at its
  // end [K]. `heat`, `stored`: D and C(T0) D there [K, J]; `change`: of the temperatures. Of no size if no c bends by more than
  // makes `negligible` [K].
  [[nodiscard]] Eigen::VectorXd stray(const HeatBalance& balance, const Eigen::VectorXd& temperature,
                                      const Eigen::VectorXd& heat, const Eigen::VectorXd& stored, const Eigen::VectorXd& change,
                                      double negligible) const {
    if (!capacity_bends_on_the_way(model_, temperature, temperature + change, negligible)) return {};
    constexpr int looks = 8;
    const auto beside = [&](double part, const Eigen::VectorXd& warmer) -> Eigen::VectorXd {
      Eigen::VectorXd at = warmer;
      for_each_shortly(at.size(), [&](Eigen::Index row) { at[row] -= rise(slope_[row], part * heat[row]); });
      return at;
    };
    Eigen::VectorXd mean = beside(1, change) / -3;
    for (int i = 0; i < looks; ++i) {
      const double part = (i + 0.5) / looks;
      const Eigen::VectorXd guess = temperature + part * change;
      mean += beside(part, balance.temperature_after(temperature, part * stored, guess) - temperature) / looks;
    }
    for (const NodeId node : model_.fixed_nodes) mean[node.value()] = 0;
    return mean;
  }

  // q of each row [1/K].
  [[nodiscard]] const Eigen::VectorXd& slope() const { return slope_; }

 private:
  static constexpr double least_way = 1e-3;  // below it q is that at T0: none can be told from rounding [K]

  void go_through(const HeatBalance& balance, const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity,
                  const Eigen::VectorXd& expected) {
    const Eigen::VectorXd stored = balance.stored(temperature, expected);
    for_each_shortly(slope_.size(), [&](Eigen::Index row) {
      const double way = expected[row] - temperature[row];
      if (std::abs(way) < least_way) return;
      const double heat = stored[row] / capacity[row];  // [K]
      slope_[row] = 2 * (heat - way) / (heat * heat);
    });
  }

  const HeatModel& model_;
  bool bends_;
  Eigen::VectorXd slope_;
};

}  // namespace scree::thermal
