// Where what drives a run jumps and bends in time, so that steps end at jumps and none leaps over a pulse.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Times just before and just after a jump, a few roundings apart [s].
struct Jump {
  double before;
  double after;
};

// Between two times, as a rule those of two outputs. A table is known. A formula is looked at, at 1,024 steps in time of one
// that is the same everywhere, else at 64 steps at up to 16 of its places; it bends where it begins or ends to rise, to fall
// or to stand still. A formula that is the same everywhere and jumps by a hundredth of its range or more from one look to the
// next, or by as much as it rises by before and after, does so at a time that is known. One that may jump at another time at
// each place is taken to bend at all times: a front or a spot that moves passes between the places that are looked at. In
// fourth order a jump reaches nodes beside those that are held: there it is two bends. Throws InputError for a value that
// breaks its rule there.
class TimeBends {
 public:
  // Refers to the model.
  TimeBends(const HeatModel& model, double begin, double end);

  // Ascending, from `begin` to `end`; of one at the end or some roundings behind it `after` is the end.
  [[nodiscard]] const std::vector<Jump>& jumps() const { return jumps_; }

  // The most bends that a condition or a load has at one place, without those at the two times.
  [[nodiscard]] std::size_t most_between(double begin, double end) const;

  // Whether any may lie between the two times: those of a formula are known to a step in time.
  [[nodiscard]] bool any_between(double begin, double end) const;

  // Whether what bends there may jump, so that what a step misses of it is in proportion to the step's length: not a formula
  // that neither compares, nor chooses, nor rounds.
  [[nodiscard]] bool may_jump_between(double begin, double end) const;

 private:
  // Of a formula at one place.
  struct Seen {
    double step;                // between looks [s]
    std::vector<double> times;  // ascending [s]
    bool may_jump;
  };

  template <class Counts>
  [[nodiscard]] bool any_between(double begin, double end, const Counts& counts) const;

  std::vector<const Function*> tables_;
  std::vector<Seen> seen_;
  std::vector<Jump> jumps_;
  bool may_jump_anywhere_ = false;
};

// Whether anything changes in time by a formula, of which looks tell alone.
bool is_looked_at(const HeatModel& model);

}  // namespace scree::thermal
