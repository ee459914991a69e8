// How much of the tolerance a step may use.
#pragma once

#include <algorithm>

#include "thermal/heat_options.h"

namespace scree::thermal {

class ErrorBudget {
 public:
  // `safety`: of the estimate of the error; see TimeScheme.
  ErrorBudget(const TimeOptions& options, double safety)
      : tolerance_(options.tolerance), until_(options.until), safety_(safety) {}

  // How much a step of this length may add to an error of which there is `error` [K].
  [[nodiscard]] double of_step(double error, double time, double length) const {
    const double left = tolerance_ / safety_ - error;
    const double spread = left * length / std::max(until_ - time, length);
    const double least = least_spread * tolerance_ * std::clamp(left / ((1 - aim) * tolerance_ / safety_), scarcest, 1.0);
    return std::max(share_of_room * (aim * tolerance_ / safety_ - error), std::clamp(spread, least, most_spread * tolerance_));
  }

  // How much a step may take away from an error or add to none, however little room is left [K].
  [[nodiscard]] double of_any() const { return share_of_room * aim * tolerance_ / safety_; }

  // At least, where something jumps within the step: what it misses of that is in proportion to its length, so that no step is
  // short enough for its share by time [K].
  [[nodiscard]] double of_jump() const { return most_spread * tolerance_; }

  // How wrong temperatures at outputs within a step may be beside the `error` at its end: no later step carries that on [K].
  [[nodiscard]] double of_passed(double error) const { return std::max(0.0, aim * tolerance_ - safety_ * error); }

 private:
  // A step may add this share of the room left below the tolerance, so that the sum stays below it however many steps there
  // are: modes that still change forget old errors as they decay, which gives room back (README, "Time").
  static constexpr double share_of_room = 0.4;
  // Where there is hardly any room a step may add its share, by time, of what is left to the tolerance: errors that do not
  // decay are spread over the whole run. But no more than the larger and no less than the smaller of these shares of the
  // tolerance, lest they stop the run: it may end above its tolerance then, and says so. The least falls with what is left
  // behind the aim, to this part of itself: else many steps of it alone would lead beyond the tolerance.
  static constexpr double most_spread = 0.02;
  static constexpr double least_spread = 4e-4;
  static constexpr double scarcest = 0.05;
  // What the step control aims at, of the tolerance.
  static constexpr double aim = 0.9;

  double tolerance_;  // [K]
  double until_;      // [s]
  double safety_;
};

}  // namespace scree::thermal
