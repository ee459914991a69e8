#include "thermal/drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "thermal/evaluated.h"
#include "thermal/exchange.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

constexpr std::size_t recent_times = 4;  // of one step and the next

struct Range {
  double least;
  double largest;
  const char* rule;
};
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range any_value{-infinity, infinity, "must be finite"};
constexpr Range kelvin{0, infinity, "must be a temperature of 0 K or more"};
constexpr Range coefficient_range{0, infinity, "must not be negative, W/m2/K"};
constexpr Range emissivity_range{0, 1, "must be from 0 to 1"};

// A function at one time, checked. Refers to all of them.
auto evaluated(const Function& function, double time, const std::string& name, const Range& range) {
  return Evaluated(function.varies_in_place(), [&function, time, &name, &range](const Eigen::Vector3d& place) {
    const double value = function(place, time);
    if (std::isfinite(value) && value >= range.least && value <= range.largest) return value;
    throw InputError(problem(
        "heat: " + name, fmt::format("{:g} at ({:g}, {:g}, {:g}) m and {:g} s", value, place.x(), place.y(), place.z(), time),
        range.rule, "Look at its expression or table there"));
  });
}

ExchangeRates rates(const Exchange& exchange, double time) {
  const std::size_t count = exchange.on.nodes.size();
  ExchangeRates result{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  const bool radiates = exchange.law == Exchange::Law::radiation;
  auto coefficient = evaluated(exchange.coefficient, time, exchange.name, radiates ? emissivity_range : coefficient_range);
  auto surroundings = evaluated(exchange.surroundings, time, exchange.name, kelvin);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d place = exchange.on.places.col(row);
    result.factor[row] = (radiates ? stefan_boltzmann : 1) * coefficient(place) * exchange.on.shares[i];
    result.surroundings[row] = surroundings(place);
  }
  return result;
}

}  // namespace

bool varies_in_time(const Hold& hold) {
  return hold.temperature.varies_in_time();
}

bool varies_in_time(const Load& load) {
  return load.density.varies_in_time();
}

bool varies_in_time(const Exchange& exchange) {
  return exchange.coefficient.varies_in_time() || exchange.surroundings.varies_in_time();
}

bool varies_in_time(const HeatModel& model) {
  const auto any = [](const auto& list) {
    return std::any_of(list.begin(), list.end(), [](const auto& one) { return varies_in_time(one); });
  };
  return holds_vary_in_time(model) || any(model.loads) || any(model.exchanges);
}

bool holds_vary_in_time(const HeatModel& model) {
  return std::any_of(model.holds.begin(), model.holds.end(), [](const Hold& hold) { return varies_in_time(hold); });
}

Drives::Drives(const HeatModel& model) : model_(model), vary_(varies_in_time(model)) {
  constant_.load = Eigen::VectorXd::Zero(model.capacity.size());
  constant_.load_sizes = Eigen::VectorXd::Zero(model.capacity.size());
  constant_.by_load.assign(model.loads.size(), 0.0);
  constant_.fixed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.fixed_nodes.size()));
  constant_.exchanges.resize(model.exchanges.size());
  evaluate(Part::constant, constant_);
}

void Drives::evaluate(Part part, Drive& drive) const {
  const bool varying = part == Part::varying;
  std::vector<decltype(evaluated({}, 0, {}, kelvin))> temperatures;
  for (const Hold& hold : model_.holds) temperatures.push_back(evaluated(hold.temperature, drive.time, hold.name, kelvin));
  for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
    const int hold = model_.fixed_hold[i];
    if (varies_in_time(model_.holds[hold]) != varying) continue;
    drive.fixed[static_cast<Eigen::Index>(i)] = temperatures[hold](model_.places.col(model_.fixed_nodes[i].value()));
  }
  Eigen::VectorXd shared = Eigen::VectorXd::Zero(model_.shared_capacity ? drive.load.size() : 0);  // of sources
  for (std::size_t l = 0; l < model_.loads.size(); ++l) {
    const Load& load = model_.loads[l];
    if (varies_in_time(load) != varying) continue;
    auto density = evaluated(load.density, drive.time, load.name, any_value);
    for (std::size_t i = 0; i < load.on.nodes.size(); ++i) {
      const double heat = load.on.shares[i] * density(load.on.places.col(static_cast<Eigen::Index>(i)));
      drive.load[load.on.nodes[i].value()] += heat;
      drive.load_sizes[load.on.nodes[i].value()] += std::abs(heat);
      drive.by_load[l] += heat;
      if (load.in_volume && shared.size() > 0) shared[load.on.nodes[i].value()] += heat;
    }
  }
  // Q - B C^-1 Q (fourth_order.h).
  if (shared.size() > 0) drive.load -= *model_.shared_capacity * shared.cwiseQuotient(model_.capacity);
  for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
    const Exchange& exchange = model_.exchanges[e];
    if (varies_in_time(exchange) == varying) drive.exchanges[e] = rates(exchange, drive.time);
  }
}

const Drive& Drives::at(double time) {
  if (!vary_) return constant_;
  const auto known = std::find_if(recent_.begin(), recent_.end(), [&](const Drive& drive) { return drive.time == time; });
  if (known != recent_.end()) {
    // The latest asked for is the last to go: a step that is tried again holds on to the one at its start.
    recent_.splice(recent_.begin(), recent_, known);
    return recent_.front();
  }
  if (recent_.size() == recent_times) recent_.pop_back();
  recent_.push_front(constant_);
  recent_.front().time = time;
  evaluate(Part::varying, recent_.front());
  return recent_.front();
}

Eigen::VectorXd held(const HeatModel& model, Eigen::VectorXd values, const Eigen::VectorXd& fixed) {
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    values[model.fixed_nodes[i].value()] = fixed[static_cast<Eigen::Index>(i)];
  }
  return values;
}

}  // namespace scree::thermal
