#include "thermal/heat_run.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "thermal/bookkeeper.h"
#include "thermal/choose_scheme.h"
#include "thermal/drive_defect.h"
#include "thermal/fourth_order.h"
#include "thermal/heat_balance.h"
#include "thermal/problems.h"
#include "thermal/stable_step.h"
#include "thermal/step_grid.h"
#include "thermal/time_bends.h"

namespace scree::thermal {

namespace {

// Step control. A step may add this share of the room left below the tolerance, so that the sum stays below it however many
// steps there are: modes that still change forget old errors as they decay, which gives room back (README, "Time").
constexpr double share_of_room = 0.4;
// Where there is hardly any room a step may add its share, by time, of what is left to the tolerance: errors that do not decay
// are spread over the whole run. But no more than the larger and no less than the smaller of these shares of the tolerance,
// lest they stop the run: it may end above its tolerance then, and says so. What a step misses of a jump is in proportion to
// its length, so that no step is short enough for its share by time: there it is the larger one.
constexpr double most_spread = 0.02;
constexpr double least_spread = 4e-4;
// What the step control aims at, of the tolerance.
constexpr double aim = 0.9;
// Steps grow when the error expected after doubling, 2^3 times this one for second order, keeps to this share of what is
// allowed.
constexpr double growth_margin = 0.8;

// Time is on an output time if it is this close to one, in output intervals.
constexpr double on_grid = 1e-9;

TimeOptions checked(const TimeOptions& options) {
  const auto refuse = [](const std::string& key, double value, const std::string& rule) {
    throw InputError(problem("heat." + key, fmt::format("{:g}", value), rule));
  };
  if (!(options.tolerance > 0)) refuse("tolerance", options.tolerance, "must be positive, K");
  if (!(options.output_every >= 0)) refuse("output_every", options.output_every, "must not be negative, s");
  if (options.step && !(*options.step > 0)) refuse("step", *options.step, "must be positive, s");
  return options;
}

// The explicit step asked for, or the largest stable one; refuses more.
double explicit_step(const HeatModel& model, const TimeOptions& options) {
  const StableStep stable = stable_step(model);
  const double step = options.step.value_or(stable.step);
  if (step > stable.step) {
    throw InputError(problem("heat.step", fmt::format("{:g} s", step),
                             fmt::format("must be at most the stable step of {:.6g} s, which node {} of block {} sets",
                                         stable.step, stable.node.value(), model.blocks[stable.node].value()),
                             "Leave the step out, or use the implicit integrator, which has no such limit"));
  }
  return step;
}

double largest(const Eigen::VectorXd& error) {
  return error.lpNorm<Eigen::Infinity>();
}

}  // namespace

class HeatRun::Implementation {
 public:
  Implementation(SharedModel model, const TimeOptions& options)
      : kept_(std::move(model)),
        model_(*kept_),
        options_(checked(options)),
        scheme_(choose_scheme(model_, options)),
        bookkeeper_(model_, scheme_.scheme->sums()),
        drives_(model_) {
    if (options.integrator == Integrator::explicit_euler) explicit_step_ = explicit_step(model_, options);
    state_.temperature = after_jump(model_, held(model_, model_.initial, drives_.at(0)));
    state_.error = Eigen::VectorXd::Zero(model_.initial.size());
    state_.ledger = bookkeeper_.open(state_.temperature);
    state_.given.include(model_.initial);
    include_drive(0);
    state_.reached.include(state_.temperature);
    if (model_.lumped) state_.lumping = lumping_.emplace(model_).start();
  }

  void resume(HeatState state) {
    const bool fits = state.temperature.size() == state_.temperature.size() && state.error.size() == state_.error.size() &&
                      state.lumping.carried.size() == state_.lumping.carried.size() &&
                      (state.matrix.temperature.size() == 0 || state.matrix.temperature.size() == state_.temperature.size()) &&
                      state.ledger.by_boundary.size() == state_.ledger.by_boundary.size() &&
                      state.ledger.by_applied.size() == state_.ledger.by_applied.size() &&
                      state.ledger.by_surroundings.size() == state_.ledger.by_surroundings.size();
    if (!fits) throw InputError(problem("heat state", "", "must have the nodes, boundaries and sources of this scene"));
    state_ = std::move(state);
    earlier_factorisations_ = state_.factorisations;
    scheme_.scheme->take_matrix(state_.matrix);
  }

  void advance_to(double target, const std::function<void(double)>& progress) {
    SCREE_EXPECT(target >= state_.time);
    const double every = options_.output_every > 0 ? options_.output_every : std::max(options_.until, target);
    while (state_.time < target) {
      const double nearest = std::round(state_.time / every);
      const bool at_output = std::abs(state_.time / every - nearest) <= on_grid;
      const double begin = at_output ? nearest * every : state_.time;
      const double next = (at_output ? nearest + 1 : std::ceil(state_.time / every)) * every;
      const bool whole = target >= next - on_grid * every;
      const double end = whole ? next : target;
      // A whole interval has the same length each time, not that of a difference of rounded times.
      const double length = at_output && whole ? every : end - begin;
      if (options_.integrator == Integrator::explicit_euler) {
        fixed_steps(begin, length, progress);
      } else {
        chosen_steps(begin, length, progress);
      }
      state_.time = std::abs(end - target) <= on_grid * every ? target : end;
    }
  }

  [[nodiscard]] const HeatState& state() const { return state_; }
  [[nodiscard]] double cost_exponent() const { return scheme_.scheme->cost_exponent(); }
  [[nodiscard]] std::string solver() const { return fmt::format("{} ({})", scheme_.scheme->name(), scheme_.why); }
  [[nodiscard]] bool within_tolerance() const { return state_.time_error <= options_.tolerance; }

 private:
  // Each stretch between two jumps has steps of its own, which know nothing of these.
  void chosen_steps(double begin, double length, const std::function<void(double)>& progress) {
    const double end = begin + length;
    const TimeBends bends(model_, begin, end);
    if (bends.jumps().empty()) return smooth_steps(begin, length, bends, progress);
    double from = begin;
    for (const Jump& jump : bends.jumps()) {
      if (jump.before > from) smooth_steps(from, jump.before - from, bends, progress);
      leap(jump.after);
      from = jump.after;
    }
    if (from < end) smooth_steps(from, end - from, bends, progress);
  }

  // What follows is as sudden as a start.
  void leap(double time) {
    const Eigen::VectorXd after = held(model_, state_.temperature, drives_.at(time));
    bookkeeper_.book_jump(state_.temperature, after, state_.ledger);
    state_.temperature = after;
    state_.reached.include(after);
    include_drive(time);
    state_.time = time;
    state_.next_step = 0;
  }

  void smooth_steps(double begin, double length, const TimeBends& bends, const std::function<void(double)>& progress) {
    if (state_.next_step <= 0) {
      state_.next_step = scheme_.scheme->first_step(instant(begin), allowed(state_.error, begin, length));
    }
    StepGrid grid(begin, length, state_.next_step);
    while (!grid.done()) {
      if (leaps(grid, bends)) {
        grid.refine();
        continue;
      }
      const double dt = grid.step();
      const std::optional<DriveDefect> missed = missed_in(grid, bends);
      const bool finest = grid.level() == StepGrid::max_level;
      const double may_add = allowed_in(missed, grid);
      if (missed && largest(missed->free) > may_add && !finest) {
        grid.refine();
        continue;
      }
      Step step = missed ? step_that_misses(*missed, grid) : scheme_.scheme->step(instant(grid.time()), dt);
      state_.factorisations = earlier_factorisations_ + scheme_.scheme->factorisations();
      if (!(step.local_error <= may_add)) {
        refine(grid, step.local_error / may_add);
        continue;
      }
      if (missed && largest(step.error) - largest(state_.error) > may_add && !finest) {
        ++state_.rejected_steps;
        grid.refine();
        continue;
      }
      grid.advance();
      state_.next_step = dt;
      for (double expected = 8 * step.local_error; state_.next_step < 4 * dt; expected *= 8) {
        if (expected > growth_margin * allowed(step.error, grid.time(), 2 * state_.next_step)) break;
        // At the interval's end the next one's grid begins, whose steps may be longer.
        if (!grid.done() && !grid.coarsen()) break;
        state_.next_step *= 2;
      }
      accept(step, dt, grid.time(), progress);
    }
  }

  // A step sees what drives it at its own times only. Whatever rises and falls again has three bends at least: with two between
  // a step's ends the step begins or ends in it.
  static bool leaps(const StepGrid& grid, const TimeBends& bends) {
    constexpr std::size_t seen = 2;
    return grid.level() < StepGrid::max_level && bends.most_between(grid.time(), grid.time() + grid.step()) > seen;
  }

  // What the scheme's own estimate of a step does not see of jumps within it [K]; nothing if there are none.
  [[nodiscard]] std::optional<DriveDefect> missed_in(const StepGrid& grid, const TimeBends& bends) const {
    if (!bends.any_between(grid.time(), grid.time() + grid.step())) return std::nullopt;
    return drive_defect(model_, scheme_.scheme->drive_quadrature(grid.step()), grid.time(), grid.step(), state_.temperature,
                        capacity_at(model_, state_.temperature));
  }

  // The step that the grid is at, with what it misses in its error.
  Step step_that_misses(const DriveDefect& missed, const StepGrid& grid) {
    Instant from = instant(grid.time());
    from.error = held(model_, std::move(from.error), missed.held);
    Step step = scheme_.scheme->step(from, grid.step());
    if (!std::isfinite(step.local_error)) return step;  // it was not solved, and has no error
    step.error = held(model_, step.error + missed.free, Eigen::VectorXd::Zero(missed.held.size()));
    return step;
  }

  // As often as a third-order local error needs, from `excess` times what is allowed.
  void refine(StepGrid& grid, double excess) {
    ++state_.rejected_steps;
    if (!std::isfinite(excess)) excess = 8;
    for (double left = excess; left > 1; left /= 8) {
      if (grid.level() == StepGrid::max_level) {
        throw RunError(
            fmt::format("The time steps fell below {:g} s at {:g} s without reaching the tolerance of {:g} K. Ask for a "
                        "larger tolerance, or look for huge loads or almost empty blocks",
                        grid.step(), state_.time, options_.tolerance));
      }
      grid.refine();
    }
  }

  void fixed_steps(double begin, double length, const std::function<void(double)>& progress) {
    const auto count = static_cast<std::int64_t>(std::max(1.0, std::ceil(length / explicit_step_)));
    const double dt = length / static_cast<double>(count);
    for (std::int64_t i = 1; i <= count; ++i) {
      const Step step = scheme_.scheme->step(instant(begin + static_cast<double>(i - 1) * dt), dt);
      accept(step, dt, begin + static_cast<double>(i) * dt, progress);
    }
  }

  // How much error a step may add [K].
  [[nodiscard]] double allowed(const Eigen::VectorXd& error, double time, double length) const {
    const double left = options_.tolerance / scheme_.scheme->safety() - largest(error);
    const double spread = left * length / std::max(options_.until - time, length);
    return std::max(share_of_what_is_aimed_at(error),
                    std::clamp(spread, least_spread * options_.tolerance, most_spread * options_.tolerance));
  }
  // By the step that the grid is at.
  [[nodiscard]] double allowed_in(const std::optional<DriveDefect>& missed, const StepGrid& grid) const {
    const double smooth = allowed(state_.error, grid.time(), grid.step());
    const bool jumps = missed && std::max(largest(missed->free), largest(missed->held)) > smooth;
    return jumps ? std::max(smooth, most_spread * options_.tolerance) : smooth;
  }
  [[nodiscard]] double share_of_what_is_aimed_at(const Eigen::VectorXd& error) const {
    return share_of_room * (aim * options_.tolerance / scheme_.scheme->safety() - largest(error));
  }

  [[nodiscard]] Instant instant(double time) const { return {time, state_.temperature, state_.error}; }

  void include_drive(double time) {
    const Drive& drive = drives_.at(time);
    state_.given.include(drive.fixed);
    for (const ExchangeRates& rates : drive.exchanges) state_.given.include(rates.surroundings);
  }

  void accept(const Step& step, double dt, double time, const std::function<void(double)>& progress) {
    bookkeeper_.book(step, state_.temperature, dt, state_.ledger);
    state_.temperature += step.change;
    state_.error = step.error;
    state_.matrix = scheme_.scheme->matrix_origin();
    if (!state_.temperature.allFinite()) {
      throw RunError(
          fmt::format("The temperatures are not finite after {:g} s. Look for huge loads or almost empty blocks", time));
    }
    state_.time = time;
    state_.time_error = std::max(state_.time_error, scheme_.scheme->safety() * largest(state_.error));
    ++state_.steps;
    state_.least_step = state_.steps == 1 ? dt : std::min(state_.least_step, dt);
    state_.largest_step = std::max(state_.largest_step, dt);
    state_.reached.include(state_.temperature);
    if (lumping_) lumping_->advance(state_.temperature, drives_.at(time), dt, state_.lumping);
    if (drives_.vary()) include_drive(time);
    if (progress) progress(time);
  }

  SharedModel kept_;
  const HeatModel& model_;
  TimeOptions options_;
  ChosenScheme scheme_;  // refers to model_
  Bookkeeper bookkeeper_;
  Drives drives_;
  std::optional<LumpingEstimate> lumping_;  // if blocks are lumped
  double explicit_step_ = 0;                // [s]
  HeatState state_;
  std::int64_t earlier_factorisations_ = 0;  // of the runs this one goes on from
};

void TemperatureRange::include(const Eigen::VectorXd& temperatures) {
  if (temperatures.size() == 0) return;
  least = std::min(least, temperatures.minCoeff());
  largest = std::max(largest, temperatures.maxCoeff());
}

double next_output(const TimeOptions& options, double time) {
  const double next = (std::floor(time / options.output_every + on_grid) + 1) * options.output_every;
  return std::min(next, options.until);
}

std::optional<double> overshoot(const HeatModel& model, const HeatState& state) {
  if (!model.loads.empty()) return std::nullopt;
  const double above = state.reached.largest - state.given.largest;
  return std::max({0.0, above, state.given.least - state.reached.least});
}

HeatRun::HeatRun(const HeatModel& model, const TimeOptions& options)
    : HeatRun(std::make_shared<const HeatModel>(model), options, std::nullopt) {}

HeatRun::HeatRun(const HeatModel& model, const TimeOptions& options, HeatState state)
    : HeatRun(std::make_shared<const HeatModel>(model), options, std::optional(std::move(state))) {}

HeatRun::HeatRun(SharedModel model, const TimeOptions& options, std::optional<HeatState> state)
    : implementation_(std::make_unique<Implementation>(std::move(model), options)) {
  if (state) implementation_->resume(*std::move(state));
}

HeatRun::~HeatRun() = default;

void HeatRun::advance_to(double time, const std::function<void(double)>& progress) {
  implementation_->advance_to(time, progress);
}

const HeatState& HeatRun::state() const {
  return implementation_->state();
}

double HeatRun::cost_exponent() const {
  return implementation_->cost_exponent();
}

std::string HeatRun::solver() const {
  return implementation_->solver();
}

bool HeatRun::within_tolerance() const {
  return implementation_->within_tolerance();
}

}  // namespace scree::thermal
