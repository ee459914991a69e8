// What acts on the nodes from outside, as numbers at one time.
#pragma once

#include <list>
#include <utility>

#include "thermal/heat_model.h"

namespace scree::thermal {

// Of one Exchange, in the order of its nodes.
struct ExchangeRates {
  Eigen::VectorXd factor;        // h A [W/K], or sigma epsilon A [W/K4]
  Eigen::VectorXd surroundings;  // [K]
};

struct Drive {
  double time = 0;                       // [s]
  Eigen::VectorXd load;                  // into each node [W]
  Eigen::VectorXd load_sizes;            // the same without signs: of a lumped block, heat in here and out there [W]
  std::vector<double> by_load;           // each load's total [W]
  Eigen::VectorXd fixed;                 // of the fixed nodes, in their order [K]
  std::vector<ExchangeRates> exchanges;  // in the model's order
};

// Whether a condition or a load changes in time; any of a model's.
bool varies_in_time(const Hold& hold);
bool varies_in_time(const Load& load);
bool varies_in_time(const Exchange& exchange);
bool varies_in_time(const HeatModel& model);
bool holds_vary_in_time(const HeatModel& model);

class Drives {
 public:
  // Evaluates what does not change once and for all; refers to the model.
  explicit Drives(const HeatModel& model);

  // Valid until three other times have been asked for. Throws InputError for a value that makes no sense: one that is not
  // finite, a temperature below 0 K, a negative coefficient, an emissivity outside 0 to 1.
  const Drive& at(double time);

  [[nodiscard]] bool vary() const { return vary_; }

 private:
  enum class Part { constant, varying };
  void evaluate(Part part, Drive& drive) const;

  const HeatModel& model_;
  bool vary_;
  Drive constant_;
  std::list<Drive> recent_;  // the latest first
};

// `values` with those of the fixed nodes, in their order, in the place of theirs; temperatures, with what the drive holds them
// at.
Eigen::VectorXd held(const HeatModel& model, Eigen::VectorXd values, const Eigen::VectorXd& fixed);
inline Eigen::VectorXd held(const HeatModel& model, Eigen::VectorXd temperature, const Drive& drive) {
  return held(model, std::move(temperature), drive.fixed);
}

}  // namespace scree::thermal
