#include "thermal/time_bends.h"

#include <algorithm>
#include <cmath>

#include "engine/base/between.h"

namespace scree::thermal {

namespace {

// Rises and falls between two looks below this share of all between the two times are none, and below this one of the value
// rounding.
constexpr double standing_still = 1e-6;
constexpr double rounding = 1e-12;

std::vector<double> bends_of(const Function& function, const Eigen::Vector3d& place, double begin, double end, int steps) {
  const auto time = [&](int i) { return begin + (end - begin) * i / steps; };
  Eigen::ArrayXd values(steps + 1);
  for (int i = 0; i <= steps; ++i) values[i] = function(place, time(i));
  const double still = std::max(standing_still * (values.maxCoeff() - values.minCoeff()), rounding * values.abs().maxCoeff());
  const auto way = [&](int i) {
    const double rise = values[i + 1] - values[i];
    return std::abs(rise) <= still ? 0 : (rise > 0 ? 1 : -1);
  };
  std::vector<double> bends;
  for (int i = 1; i < steps; ++i) {
    if (way(i) != way(i - 1)) bends.push_back(time(i));
  }
  return bends;
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
      seen_.push_back({(end - begin) / steps_of_one, bends_of(function, Eigen::Vector3d::Zero(), begin, end, steps_of_one)});
      return;
    }
    const Eigen::Matrix3Xd places = places_of();
    const Eigen::Index count = std::min(places.cols(), most_places);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3d place = places.col(i * places.cols() / count);
      seen_.push_back({(end - begin) / steps_of_many, bends_of(function, place, begin, end, steps_of_many)});
    }
  });
}

std::size_t TimeBends::most_between(double begin, double end) const {
  std::size_t most = 0;
  for (const Function* table : tables_) most = std::max(most, table->bends_between(begin, end).value_or(0));
  for (const Seen& seen : seen_) most = std::max(most, count_between(seen.times, begin, end));
  return most;
}

bool TimeBends::any_between(double begin, double end) const {
  return std::any_of(tables_.begin(), tables_.end(),
                     [&](const Function* table) { return table->bends_between(begin, end).value_or(0) > 0; }) ||
         std::any_of(seen_.begin(), seen_.end(),
                     [&](const Seen& seen) { return count_between(seen.times, begin - seen.step, end + seen.step) > 0; });
}

}  // namespace scree::thermal
