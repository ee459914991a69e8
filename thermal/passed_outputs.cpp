#include "thermal/passed_outputs.h"

#include <cmath>
#include <limits>

#include "thermal/heat_balance.h"
#include "thermal/step_grid.h"
#include "thermal/time_bends.h"
#include "thermal/time_options.h"

namespace scree::thermal {

namespace {

// A step that passes outputs takes two intervals at least, and each is at most four times the one before: shorter ones than
// this, of an output interval, are not among the four that it needs.
constexpr double least_remembered = 0.125 * (1 - 1e-9);
// Of the tolerance: nodes whose temperature changes by less in a step, or is changed by less by a kink, bend nothing that is
// seen at outputs.
constexpr double least_bending = 0.1;
// So that formulas are looked at as often as outputs are asked for, however quiet it was: 16 times an interval, at each of some
// places once (time_bends.h).
constexpr double most_of_formulas = 64;

}  // namespace

PassedOutputs::PassedOutputs(const HeatModel& model, const TimeOptions& options)
    : model_(model),
      driven_(varies_in_time(model)),
      most_(is_looked_at(model) ? most_of_formulas : std::numeric_limits<double>::infinity()),
      every_(options.output_every),
      until_(options.until),
      tolerance_(options.tolerance) {}

double PassedOutputs::intervals_from(double nearest, double every, double limit, const StepEnds& earlier,
                                     double next_step) const {
  double count = 1;
  constexpr std::size_t earliest = BetweenSteps::ends_before - 2;
  if (earlier.size() <= earliest) return count;
  const auto fits = [&](double more) {
    return more <= most_ && StepGrid(0, more * every, next_step).level() == 0 && std::fmod(nearest, more) == 0 &&
           (nearest + more) * every <= limit + on_grid * every &&
           are_smooth(earlier[earliest].time, (nearest + more) * every) &&
           are_smooth(nearest * every, nearest * every + more * every);
  };
  while (fits(2 * count)) count *= 2;
  return count;
}

bool PassedOutputs::any_in(double step) const {
  return every_ > 0 && step > 1.5 * every_;
}

StepEnds PassedOutputs::ends_behind(const Way& way, const StepEnds& earlier) const {
  const StepEnd start = start_of(way);
  return start.temperature && bends_in(way) ? StepEnds() : followed_by(start, earlier);
}

double PassedOutputs::error(const Way& way, const StepEnds& ends) const {
  if (!any_in(way.length)) return 0;
  if (ends.size() < BetweenSteps::ends_before) return std::numeric_limits<double>::infinity();
  const double end = way.begin + way.length;
  return BetweenSteps(end, way.from + way.change, ends).error(way.begin + every_, end - 0.5 * every_, every_);
}

bool PassedOutputs::bends_in(const Way& way) const {
  return capacity_bends_on_the_way(model_, way.from, way.from + way.change, least_bending * tolerance_);
}

bool PassedOutputs::are_smooth(double begin, double end) const {
  if (!driven_) return true;
  const TimeBends bends(model_, begin, end);
  return bends.jumps().empty() && !bends.any_between(begin, end);
}

// Without temperatures if no output that a step passes will ask for them.
StepEnd PassedOutputs::start_of(const Way& way) const {
  const bool may_serve = every_ > 0 && every_ < until_ && way.length >= least_remembered * every_;
  return {way.begin, may_serve ? std::make_shared<const Eigen::VectorXd>(way.from) : nullptr};
}

}  // namespace scree::thermal
