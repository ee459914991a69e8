#include "thermal/time_bends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/between.h"
#include "engine/base/check.h"

namespace scree::thermal {

namespace {

// Rises and falls between two looks below this share of all between the two times are none, and below this one of the value
// rounding.
constexpr double standing_still = 1e-6;
constexpr double rounding = 1e-12;

// What rises by less than this share of the range from one look to the next is not asked whether it jumps; a jump is nearly
// all of that rise. A smaller one is seen in what rises by more than twice as much as before and after, and is some of it.
constexpr double least_jump = 0.01;
constexpr double nearly_all = 0.9;
constexpr double sudden = 2;
constexpr double some = 0.4;
// Roundings that a jump's two times are set apart by: the times of steps beside it are sums.
constexpr double apart = 16 * std::numeric_limits<double>::epsilon();

// A function at one place, looked at in equal steps in time.
class Looks {
 public:
  Looks(const Function& function, Eigen::Vector3d place, double begin, double end, int steps)
      : function_(function), place_(std::move(place)), begin_(begin), end_(end), steps_(steps), values_(steps + 1) {
    for (int i = 0; i <= steps; ++i) values_[i] = function_(place_, time(i));
    range_ = values_.maxCoeff() - values_.minCoeff();
    still_ = std::max(standing_still * range_, rounding * values_.abs().maxCoeff());
  }

  // Where it begins or ends to rise, to fall or to stand still, but for the jumps that are in steps beside.
  [[nodiscard]] std::vector<double> bends(const std::vector<Jump>& jumps) const {
    const auto way = [&](int i) { return rise(i) <= still_ ? 0 : (values_[i + 1] > values_[i] ? 1 : -1); };
    const auto leaps = [&](int i) {
      return std::any_of(jumps.begin(), jumps.end(),
                         [&](const Jump& jump) { return jump.before < time(i + 1) && jump.after > time(i); });
    };
    std::vector<double> bends;
    for (int i = 1; i < steps_; ++i) {
      if (way(i) != way(i - 1) && !leaps(i) && !leaps(i - 1)) bends.push_back(time(i));
    }
    return bends;
  }

  [[nodiscard]] std::vector<Jump> jumps() const {
    std::vector<Jump> jumps;
    for (int i = 0; i < steps_; ++i) {
      const bool small = rise(i) <= least_jump * range_;
      if (small && !is_sudden(i)) continue;
      if (const std::optional<Jump> jump = jump_after(i, small ? some : nearly_all)) jumps.push_back(*jump);
    }
    if (const std::optional<Jump> jump = jump_at_end()) jumps.push_back(*jump);
    return jumps;
  }

 private:
  [[nodiscard]] double time(int i) const { return i == steps_ ? end_ : begin_ + (end_ - begin_) * i / steps_; }

  // From a look to the next, up or down.
  [[nodiscard]] double rise(int i) const { return std::abs(values_[i + 1] - values_[i]); }
  [[nodiscard]] bool is_sudden(int i) const {
    const double beside = std::max(i > 0 ? rise(i - 1) : 0, i + 1 < steps_ ? rise(i + 1) : 0);
    return function_.may_jump() && rise(i) > sudden * beside + still_;
  }

  // Between a look and the next, by halving: nothing if less than a share of the rise is left.
  [[nodiscard]] std::optional<Jump> jump_after(int i, double share) const {
    double low = time(i), high = time(i + 1);
    double under = values_[i], over = values_[i + 1];
    const double least = share * std::abs(over - under);
    for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) {
      const double value = function_(place_, middle);
      const bool below = std::abs(value - under) > std::abs(over - value);
      (below ? high : low) = middle;
      (below ? over : under) = value;
      if (!(std::abs(over - under) >= least)) return std::nullopt;
    }
    return around(low, high);
  }

  // Nothing, but for one that lies a few roundings behind the end and counts as at it: the times of the last step are sums that
  // may come to lie there, and it would see what is behind the jump.
  [[nodiscard]] std::optional<Jump> jump_at_end() const {
    const double behind = end_ + apart * std::abs(end_), last = values_[steps_];
    try {
      if (std::abs(function_(place_, behind) - last) > std::max(least_jump * range_, rounding * std::abs(last)))
        return around(end_, end_);
    } catch (const InputError&) {
      // It need not have a value there.
    }
    return std::nullopt;
  }

  [[nodiscard]] Jump around(double low, double high) const {
    return {std::max(begin_, low - apart * std::abs(low)), std::min(end_, high + apart * std::abs(high))};
  }

  const Function& function_;
  Eigen::Vector3d place_;
  double begin_, end_;  // [s]
  int steps_;
  Eigen::ArrayXd values_;
  double range_, still_;  // of all values; a rise that is none
};

// In ascending order; those of several functions at one time are one.
std::vector<Jump> merged(std::vector<Jump> jumps) {
  std::sort(jumps.begin(), jumps.end(), [](const Jump& a, const Jump& b) { return a.before < b.before; });
  std::vector<Jump> merged;
  for (const Jump& jump : jumps) {
    if (!merged.empty() && jump.before <= merged.back().after) {
      merged.back().after = std::max(merged.back().after, jump.after);
    } else {
      merged.push_back(jump);
    }
  }
  return merged;
}

Eigen::Matrix3Xd places_of_hold(const HeatModel& model, std::size_t hold) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    if (model.fixed_hold[i] == static_cast<int>(hold)) rows.push_back(model.fixed_nodes[i].value());
  }
  return model.places(Eigen::all, rows);
}

// Each function that changes in time, and what tells where it acts.
template <typename Visit>
void for_each_change(const HeatModel& model, const Visit& visit) {
  const auto look = [&](const Function& function, const auto& places) {
    if (function.varies_in_time()) visit(function, places);
  };
  for (std::size_t h = 0; h < model.holds.size(); ++h) {
    look(model.holds[h].temperature, [&] { return places_of_hold(model, h); });
  }
  for (const Load& load : model.loads) {
    look(load.density, [&] { return load.on.places; });
  }
  for (const Exchange& exchange : model.exchanges) {
    look(exchange.coefficient, [&] { return exchange.on.places; });
    look(exchange.surroundings, [&] { return exchange.on.places; });
  }
}

}  // namespace

TimeBends::TimeBends(const HeatModel& model, double begin, double end) {
  constexpr int steps_of_one = 1024;
  constexpr int steps_of_many = 64;
  constexpr Eigen::Index most_places = 16;
  for_each_change(model, [&](const Function& function, const auto& places_of) {
    if (function.bends_between(begin, end)) {
      tables_.push_back(&function);
      return;
    }
    if (!function.varies_in_place()) {
      const Looks looks(function, Eigen::Vector3d::Zero(), begin, end, steps_of_one);
      const std::vector<Jump> jumps = model.shared_capacity ? std::vector<Jump>() : looks.jumps();
      seen_.push_back({(end - begin) / steps_of_one, looks.bends(jumps), function.may_jump()});
      jumps_.insert(jumps_.end(), jumps.begin(), jumps.end());
      return;
    }
    const bool may_jump = function.may_jump();
    may_jump_anywhere_ = may_jump_anywhere_ || may_jump;
    const Eigen::Matrix3Xd places = places_of();
    const Eigen::Index count = std::min(places.cols(), most_places);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3d place = places.col(i * places.cols() / count);
      seen_.push_back({(end - begin) / steps_of_many, Looks(function, place, begin, end, steps_of_many).bends({}), may_jump});
    }
  });
  jumps_ = merged(std::move(jumps_));
}

bool is_looked_at(const HeatModel& model) {
  bool any = false;
  for_each_change(model, [&](const Function& function, const auto&) { any = any || !function.bends_between(0, 0); });
  return any;
}

std::size_t TimeBends::most_between(double begin, double end) const {
  std::size_t most = 0;
  for (const Function* table : tables_) most = std::max(most, table->bends_between(begin, end).value_or(0));
  for (const Seen& seen : seen_) most = std::max(most, count_between(seen.times, begin, end));
  return most;
}

template <class Counts>
bool TimeBends::any_between(double begin, double end, const Counts& counts) const {
  return may_jump_anywhere_ ||
         std::any_of(tables_.begin(), tables_.end(),
                     [&](const Function* table) { return table->bends_between(begin, end).value_or(0) > 0; }) ||
         std::any_of(seen_.begin(), seen_.end(), [&](const Seen& seen) {
           return counts(seen) && count_between(seen.times, begin - seen.step, end + seen.step) > 0;
         });
}

bool TimeBends::any_between(double begin, double end) const {
  return any_between(begin, end, [](const Seen&) { return true; });
}

bool TimeBends::may_jump_between(double begin, double end) const {
  return any_between(begin, end, [](const Seen& seen) { return seen.may_jump; });
}

}  // namespace scree::thermal
