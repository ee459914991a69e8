// Outputs that steps pass: how many a step may pass, what is kept for them, and how far off they are.
#pragma once

#include "thermal/between_steps.h"
#include "thermal/drive.h"
#include "thermal/heat_options.h"

namespace scree::thermal {

class PassedOutputs {
 public:
  // Refers to the model.
  PassedOutputs(const HeatModel& model, const TimeOptions& options);

  // How many intervals between outputs, from the one of this number on and no further than `limit`, the next step may take at
  // once: a power of two that begins at a multiple of itself. The temperatures are to be smooth from the first of the ends on
  // that the cubic needs, and in the span as its steps will look at it, which may see a shorter pulse.
  [[nodiscard]] double intervals_from(double nearest, double every, double limit, const StepEnds& earlier,
                                      double next_step) const;

  [[nodiscard]] bool any_in(double step) const;

  // A step from its start on; refers to both.
  struct Way {
    double begin;                   // [s]
    double length;                  // [s]
    const Eigen::VectorXd& from;    // one per row of the model [K]
    const Eigen::VectorXd& change;  // [K]
  };

  // What outputs that this step or later ones pass are made from: nothing from before the temperatures were bent.
  [[nodiscard]] StepEnds ends_behind(const Way& way, const StepEnds& earlier) const;

  // At the outputs that the step passes [K]; 0 if there are none, and infinite if there are too few `ends` for them.
  [[nodiscard]] double error(const Way& way, const StepEnds& ends) const;

 private:
  [[nodiscard]] bool bends_in(const Way& way) const;
  [[nodiscard]] bool are_smooth(double begin, double end) const;
  [[nodiscard]] StepEnd start_of(const Way& way) const;

  const HeatModel& model_;
  bool driven_;       // by what varies in time
  double most_;       // intervals that a step may pass
  double every_;      // 0 if nothing is put out on the way [s]
  double until_;      // [s]
  double tolerance_;  // [K]
};

}  // namespace scree::thermal
