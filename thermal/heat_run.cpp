#include "thermal/heat_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "thermal/between_steps.h"
#include "thermal/bookkeeper.h"
#include "thermal/choose_scheme.h"
#include "thermal/drive_defect.h"
#include "thermal/error_budget.h"
#include "thermal/error_growth.h"
#include "thermal/fitting_state.h"
#include "thermal/fourth_order.h"
#include "thermal/heat_balance.h"
#include "thermal/passed_outputs.h"
#include "thermal/problems.h"
#include "thermal/step_grid.h"
#include "thermal/time_bends.h"
#include "thermal/time_options.h"

namespace scree::thermal {

namespace {

// Steps grow when the error expected after doubling, 2^3 times this one for second order, keeps to this share of what is
// allowed.
constexpr double growth_margin = 0.8;
// What a step misses at some places of a formula of place is nothing below this share of what the step may add, and what a
// curve's bends make below this share of the tolerance.
constexpr double negligible_share = 0.01;
// How many times the error of a step, of third order, is that of half of it.
constexpr double twice_too_long = 8;

}  // namespace

class HeatRun::Implementation {
 public:
  Implementation(SharedModel model, const TimeOptions& options)
      : kept_(std::move(model)),
        model_(*kept_),
        options_(checked(options)),
        scheme_(choose_scheme(model_, options)),
        budget_(options, scheme_.scheme->safety()),
        growth_(model_),
        bookkeeper_(model_, scheme_.scheme->sums()),
        drives_(model_),
        passed_(model_, options) {
    if (options.integrator == Integrator::explicit_euler) explicit_step_ = explicit_step(model_, options);
    state_.temperature = after_jump(model_, held(model_, model_.initial, drives_.at(0)));
    state_.error = Eigen::VectorXd::Zero(model_.initial.size());
    state_.ledger = bookkeeper_.open(state_.temperature);
    state_.given.include(model_.initial);
    include_drive(0);
    state_.reached.include(state_.temperature);
    if (growth_.counts()) {
      growth_.include(given_until(drives_, options_.until, state_.temperature, capacity_at(model_, state_.temperature)));
    }
    find_growth();
    if (model_.lumped) state_.lumping = lumping_.emplace(model_).start();
  }

  void resume(HeatState state) {
    if (!fits(state, state_))
      throw InputError(problem("heat state", "", "must have the nodes, boundaries and sources of this scene"));
    state_ = std::move(state);
    scheme_.scheme->take_matrix(state_.matrix);
    find_growth();
    // The matrix that is there again was counted when it was made.
    earlier_factorisations_ = state_.factorisations - scheme_.scheme->factorisations();
  }

  void advance_to(double target, const Progress& progress) {
    SCREE_EXPECT(target >= state_.time);
    while (state_.time < target) take_steps(next_span(target), progress);
  }

  void follow(const AtOutput& at_output, const Progress& progress) {
    const double close = on_grid * options_.output_every;
    double output = next_output(options_, state_.time);
    const auto tell = [&](const Eigen::VectorXd& temperature, bool resumable) {
      at_output({output, temperature, resumable});
      output = next_output(options_, output);
    };
    while (state_.time < options_.until) {
      const Span span = next_span(options_.until);
      take_steps(span, [&](double time) {
        while (output < span.end && output <= time + close) {
          tell(output >= time - close ? state_.temperature : passed_at(output), false);
        }
        if (progress) progress(time);
      });
      if (output == span.end) tell(state_.temperature, true);
    }
  }

  [[nodiscard]] const HeatState& state() const { return state_; }
  [[nodiscard]] WorkDone work_done() const {
    return {step_times(options_, varies_in_time(model_)), scheme_.scheme->cost_exponent()};
  }
  [[nodiscard]] std::string solver() const { return fmt::format("{} ({})", scheme_.scheme->name(), scheme_.why()); }
  [[nodiscard]] bool within_tolerance() const { return state_.time_error <= options_.tolerance; }

 private:
  [[nodiscard]] static double largest(const Eigen::VectorXd& error) { return error.lpNorm<Eigen::Infinity>(); }

  // One interval between outputs, several if steps are that long, or what is left of one. A run can go on from its end.
  struct Span {
    double begin;   // [s]
    double length;  // [s]
    double end;     // [s]
  };

  [[nodiscard]] Span next_span(double limit) const {
    const double every = options_.output_every > 0 ? options_.output_every : std::max(options_.until, limit);
    const double nearest = std::round(state_.time / every);
    const bool at_output = std::abs(state_.time / every - nearest) <= on_grid;
    const double begin = at_output ? nearest * every : state_.time;
    const double count = at_output ? passed_.intervals_from(nearest, every, limit, state_.earlier, state_.next_step) : 1;
    const double next = (at_output ? nearest + count : std::ceil(state_.time / every)) * every;
    const bool whole = limit >= next - on_grid * every;
    const double end = whole ? next : limit;
    // A whole interval has the same length each time, not that of a difference of rounded times.
    const double length = at_output && whole ? count * every : end - begin;
    return {begin, length, std::abs(end - limit) <= on_grid * every ? limit : end};
  }

  void take_steps(const Span& span, const Progress& progress) {
    if (options_.integrator == Integrator::explicit_euler) {
      fixed_steps(span.begin, span.length, progress);
    } else {
      chosen_steps(span, progress);
    }
    state_.time = span.end;
  }

  // Each stretch between two jumps has steps of its own, which know nothing of these.
  void chosen_steps(const Span& span, const Progress& progress) {
    const TimeBends bends(model_, span.begin, span.end);
    if (bends.jumps().empty()) return smooth_steps(span.begin, span.length, bends, progress);
    double from = span.begin;
    for (const Jump& jump : bends.jumps()) {
      if (jump.before > from) smooth_steps(from, jump.before - from, bends, progress);
      leap(jump.after);
      from = jump.after;
    }
    if (from < span.end) smooth_steps(from, span.end - from, bends, progress);
  }

  // What follows is as sudden as a start.
  void leap(double time) {
    const Eigen::VectorXd after = held(model_, state_.temperature, drives_.at(time));
    bookkeeper_.book_jump(state_.temperature, after, state_.ledger);
    state_.temperature = after;
    state_.reached.include(after);
    include_drive(time);
    find_growth();
    state_.time = time;
    state_.next_step = 0;
    state_.rate.resize(0);
    state_.earlier.clear();
  }

  void smooth_steps(double begin, double length, const TimeBends& bends, const Progress& progress) {
    if (state_.next_step <= 0) {
      state_.next_step = scheme_.scheme->first_step(instant(begin), budget_.of_step(may_become(state_.error), begin, length));
    }
    StepGrid grid(begin, length, state_.next_step);
    while (!grid.done()) {
      if (leaps(grid, bends)) {
        grid.refine();
        continue;
      }
      const double dt = grid.step();
      const ThreadsInScope threads(std::max(1, threads_in_use() - scheme_.scheme->threads_beside(dt)));
      const double share = budget_.of_step(may_become(state_.error), grid.time(), dt);
      const std::optional<DriveDefect> missed = missed_in(grid.time(), dt, bends, share);
      const bool finest = grid.level() == StepGrid::max_level;
      const double may_add = allowed_in(missed, grid, bends, share);
      if (missed && may_become(missed->free) > may_add && !finest) {
        grid.refine();
        continue;
      }
      const Step step = take(grid.time(), dt, missed);
      state_.factorisations = earlier_factorisations_ + scheme_.scheme->factorisations();
      if (step.local.size() == 0) {
        refine(grid, twice_too_long);
        continue;
      }
      Eigen::VectorXd growth;
      if (growth_.counts()) growth = growth_.at(state_.temperature + step.change);
      const double local = growth_.largest(step.local, growth), error = growth_.largest(step.error, growth);
      const double added = ErrorGrowth::largest_rise(step.error, step.local, growth);
      const double most = std::max(may_add, budget_.of_any());
      if (!(added <= may_add && local <= most)) {
        refine(grid, std::max(added / may_add, local / most));
        continue;
      }
      if (missed && error - may_become(state_.error) > may_add && !finest && misses(step, *missed, growth) > may_add) {
        ++state_.rejected_steps;
        grid.refine();
        continue;
      }
      const PassedOutputs::Way way{grid.time(), dt, state_.temperature, step.change};
      const StepEnds ends = passed_.ends_behind(way, state_.earlier);
      const double between = passed_.error(way, ends);
      if (between > budget_.of_passed(largest(step.error))) {
        ++state_.rejected_steps;
        grid.refine();
        continue;
      }
      const auto errs_little = [&](double next) {
        const double times = std::pow(next / dt, 3);
        return times * added <= growth_margin * budget_.of_step(error, grid.time(), next) &&
               times * local <= growth_margin * budget_.of_any();
      };
      state_.next_step = grid.advance(errs_little);
      state_.earlier = ends;
      growth_now_ = std::move(growth);
      accept(step, dt, grid.time(), between, progress);
    }
  }

  // At an output that the last step passed.
  [[nodiscard]] Eigen::VectorXd passed_at(double time) {
    return held(model_, BetweenSteps(state_.time, state_.temperature, state_.earlier).at(time), drives_.at(time));
  }

  // A step sees what drives it at its own times only. Whatever rises and falls again has three bends at least: with two between
  // a step's ends the step begins or ends in it.
  static bool leaps(const StepGrid& grid, const TimeBends& bends) {
    constexpr std::size_t seen = 2;
    return grid.level() < StepGrid::max_level && bends.most_between(grid.time(), grid.time() + grid.step()) > seen;
  }

  // What the scheme's own estimate of a step does not see of what changes within it [K]; nothing if nothing does. A step that
  // is so long that it may pass outputs, or that nothing has chosen, is looked at as one in which something bends. `share`:
  // what a smooth step may add [K].
  [[nodiscard]] std::optional<DriveDefect> missed_in(double begin, double length, const TimeBends& bends, double share) const {
    if (!drives_.vary()) return std::nullopt;
    const bool fixed = options_.integrator == Integrator::explicit_euler;
    const bool smooth = !fixed && !passed_.any_in(length) && !bends.any_between(begin, begin + length);
    return drive_defect(model_, scheme_.scheme->drive_quadrature(length), {begin, length, smooth, negligible_share * share},
                        state_.temperature, capacity_at(model_, state_.temperature));
  }

  // A step with what it misses in its error.
  Step take(double begin, double length, const std::optional<DriveDefect>& missed) {
    if (!missed) return scheme_.scheme->step(instant(begin), length);
    Instant from = instant(begin);
    from.error = held(model_, std::move(from.error), missed->held);
    Step step = scheme_.scheme->step(from, length);
    if (step.local.size() == 0) return step;  // it was not solved, and has no error
    step.error = held(model_, step.error + missed->free, Eigen::VectorXd::Zero(missed->held.size()));
    return step;
  }

  // What a step and its drive add to errors, those that grow as they are carried left out [K].
  [[nodiscard]] static double misses(const Step& step, const DriveDefect& missed, const Eigen::VectorXd& growth) {
    return std::max(largest(missed.held), ErrorGrowth::largest_rise(step.error, step.local + missed.free, growth));
  }

  // As often as a third-order local error needs, from `excess` times what is allowed.
  void refine(StepGrid& grid, double excess) {
    ++state_.rejected_steps;
    if (!std::isfinite(excess)) excess = twice_too_long;
    for (double left = excess; left > 1; left /= twice_too_long) {
      if (grid.level() == StepGrid::max_level) {
        throw RunError(
            fmt::format("The time steps fell below {:g} s at {:g} s without reaching the tolerance of {:g} K. Ask for a "
                        "larger tolerance, or look for huge loads or almost empty blocks",
                        grid.step(), state_.time, options_.tolerance));
      }
      grid.refine();
    }
  }

  void fixed_steps(double begin, double length, const Progress& progress) {
    const auto count = static_cast<std::int64_t>(std::max(1.0, std::ceil(length / explicit_step_)));
    const double dt = length / static_cast<double>(count);
    const TimeBends bends(model_, begin, begin + length);
    for (std::int64_t i = 1; i <= count; ++i) {
      const double from = begin + static_cast<double>(i - 1) * dt;
      accept(take(from, dt, missed_in(from, dt, bends, 0)), dt, begin + static_cast<double>(i) * dt, 0, progress);
    }
  }

  // How much error the step that the grid is at may add, whose share is that of a smooth one [K].
  [[nodiscard]] double allowed_in(const std::optional<DriveDefect>& missed, const StepGrid& grid, const TimeBends& bends,
                                  double share) const {
    const bool jumps = missed && std::max(may_become(missed->free), largest(missed->held)) > share &&
                       bends.may_jump_between(grid.time(), grid.time() + grid.step());
    return jumps ? std::max(share, budget_.of_jump()) : share;
  }

  // What errors of nodes may become, as they are now [K].
  [[nodiscard]] double may_become(const Eigen::VectorXd& error) const { return growth_.largest(error, growth_now_); }

  [[nodiscard]] Instant instant(double time) const {
    return {time, state_.temperature, state_.error, state_.rate, state_.reached, negligible_share * options_.tolerance};
  }

  void include_drive(double time) { state_.given.include(drives_.at(time)); }

  // Where the state has come to.
  void find_growth() {
    include_range();
    growth_now_ = growth_.at(state_.temperature);
  }
  bool include_range() {
    const bool given = growth_.include(state_.given), reached = growth_.include(state_.reached);
    return given || reached;
  }

  // `between`: the error at outputs that the step passes [K].
  void accept(const Step& step, double dt, double time, double between, const Progress& progress) {
    bookkeeper_.book(step, state_.temperature, dt, state_.ledger);
    state_.temperature += step.change;
    state_.error = step.error;
    if (growth_.counts()) state_.rate = step.change / dt;
    state_.matrix = scheme_.scheme->matrix_origin();
    if (!state_.temperature.allFinite()) {
      throw RunError(
          fmt::format("The temperatures are not finite after {:g} s. Look for huge loads or almost empty blocks", time));
    }
    state_.time = time;
    state_.time_error = std::max(state_.time_error, scheme_.scheme->safety() * largest(state_.error) + between);
    ++state_.steps;
    state_.least_step = state_.steps == 1 ? dt : std::min(state_.least_step, dt);
    state_.largest_step = std::max(state_.largest_step, dt);
    state_.reached.include(state_.temperature);
    if (drives_.vary()) include_drive(time);
    if (lumping_) {
      TemperatureRange range = state_.reached;
      range.include(state_.given);
      lumping_->advance(state_.temperature, drives_.at(time), dt, range, state_.lumping);
    }
    if (include_range()) growth_now_ = growth_.at(state_.temperature);
    if (progress) progress(time);
  }

  SharedModel kept_;
  const HeatModel& model_;
  TimeOptions options_;
  ChosenScheme scheme_;  // refers to model_
  ErrorBudget budget_;
  ErrorGrowth growth_;
  Eigen::VectorXd growth_now_;  // at the state's temperatures
  Bookkeeper bookkeeper_;
  Drives drives_;
  PassedOutputs passed_;
  std::optional<LumpingEstimate> lumping_;  // if blocks are lumped
  double explicit_step_ = 0;                // [s]
  HeatState state_;
  std::int64_t earlier_factorisations_ = 0;  // of the runs this one goes on from
};

HeatRun::HeatRun(const HeatModel& model, const TimeOptions& options)
    : HeatRun(std::make_shared<const HeatModel>(model), options, std::nullopt) {}

HeatRun::HeatRun(const HeatModel& model, const TimeOptions& options, HeatState state)
    : HeatRun(std::make_shared<const HeatModel>(model), options, std::optional(std::move(state))) {}

HeatRun::HeatRun(SharedModel model, const TimeOptions& options, std::optional<HeatState> state)
    : implementation_(std::make_unique<Implementation>(std::move(model), options)) {
  if (state) implementation_->resume(*std::move(state));
}

HeatRun::~HeatRun() = default;

void HeatRun::advance_to(double time, const Progress& progress) {
  implementation_->advance_to(time, progress);
}

void HeatRun::follow(const AtOutput& at_output, const Progress& progress) {
  implementation_->follow(at_output, progress);
}

const HeatState& HeatRun::state() const {
  return implementation_->state();
}

WorkDone HeatRun::work_done() const {
  return implementation_->work_done();
}

std::string HeatRun::solver() const {
  return implementation_->solver();
}

bool HeatRun::within_tolerance() const {
  return implementation_->within_tolerance();
}

}  // namespace scree::thermal
