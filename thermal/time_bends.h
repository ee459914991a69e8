// Where what drives a run bends in time, so that no step leaps over a pulse.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Between two times, as a rule those of two outputs. A table is known. A formula is looked at, at 1,024 steps in time of one
// that is the same everywhere, else at 64 steps at up to 16 of its places; it bends where it begins or ends to rise, to fall
// or to stand still. Throws InputError for a value that breaks its rule there.
class TimeBends {
 public:
  // Refers to the model.
  TimeBends(const HeatModel& model, double begin, double end);

  // The most bends that a condition or a load has at one place, without those at the two times.
  [[nodiscard]] std::size_t most_between(double begin, double end) const;

  // Whether any may lie between the two times: those of a formula are known to a step in time.
  [[nodiscard]] bool any_between(double begin, double end) const;

 private:
  // Of a formula at one place.
  struct Seen {
    double step;                // between looks [s]
    std::vector<double> times;  // ascending [s]
  };

  std::vector<const Function*> tables_;
  std::vector<Seen> seen_;
};

}  // namespace scree::thermal
