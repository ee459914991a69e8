#include "thermal/heat_balance.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "engine/base/phases.h"
#include "thermal/exchange.h"

namespace scree::thermal {

namespace {

constexpr int most_iterations = 60;  // of Newton's for a temperature
constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

// Of a curve, continued below 0 K by its value there, where an iteration may stray.
double integral(const Curve& curve, double temperature) {
  return temperature >= 0 ? curve.integral(temperature) : curve.integral(0) + curve(0) * temperature;
}
double value(const Curve& curve, double temperature) {
  return curve(std::max(temperature, 0.0));
}

using CurveLists = std::vector<Curve> VaryingProperties::*;

// f(curve of the node's material, row of the node) of each node. Throws what f throws for the first of them.
template <class Value>
Eigen::VectorXd at_rows(const VaryingProperties& properties, CurveLists list, const Value& f) {
  const std::vector<Curve>& curves = properties.*list;
  Eigen::VectorXd result(properties.mass.size());
  const auto rows = static_cast<std::size_t>(result.size());
  std::vector<std::exception_ptr> failures(chunk_count(rows));
  for_short_chunks(rows, [&](Chunk chunk) {
    try {
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        result[row] = f(curves[static_cast<std::size_t>(properties.material[NodeId(i)])], row);
      }
    } catch (...) {
      failures[chunk.number] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return result;
}

// f(curve, temperature of the node) of each.
template <class Value>
Eigen::VectorXd at_nodes(const VaryingProperties& properties, CurveLists list, const Eigen::VectorXd& temperature,
                         const Value& f) {
  return at_rows(properties, list, [&](const Curve& curve, Eigen::Index row) { return f(curve, temperature[row]); });
}

// Into the i-th node of an exchange, which is the model's e-th; along a tangent, if there is one [W].
double exchanged_at(const Exchange& with, std::size_t e, Eigen::Index i, const Eigen::VectorXd& temperature, const Drive& drive,
                    const TangentPoint* tangent) {
  const int row = with.on.nodes[static_cast<std::size_t>(i)].value();
  if (tangent == nullptr) return exchanged_heat(with.law, drive.exchanges[e], i, temperature[row]);
  const double at = tangent->temperature[row];
  return exchanged_heat(with.law, drive.exchanges[e], i, at) -
         exchange_slope(with.law, tangent->drive.exchanges[e], i, at) * (temperature[row] - at);
}

// Where the curve's integral is that at `from` and `rise` more [K]. Newton's iteration from a guess on, which halves
// what is left where it would leave it.
double integrated_to(const Curve& curve, double from, double rise, double guess) {
  if (curve.constant()) return from + rise / *curve.constant();
  const double wanted = integral(curve, from) + rise;
  double low = -std::numeric_limits<double>::infinity();
  double high = -low;
  double at = guess;
  for (int iteration = 0; iteration < most_iterations && std::isfinite(at); ++iteration) {
    const double over = integral(curve, at) - wanted;
    (over > 0 ? high : low) = at;
    double next = at - over / value(curve, at);
    if (!(next > low && next < high)) next = std::isfinite(low + high) ? 0.5 * (low + high) : next;
    if (std::abs(next - at) <= rounding * std::abs(at)) return next;
    at = next;
  }
  return at;
}

}  // namespace

HeatBalance::HeatBalance(const HeatModel& model, Sums sums)
    : model_(model),
      flows_(&model.conductance, sums),
      unit_flows_(model.varying ? &model.varying->unit_conductance : nullptr, sums) {}

Eigen::VectorXd HeatBalance::heating(const Eigen::VectorXd& temperature, const Drive& drive) const {
  Eigen::VectorXd heat = driven(temperature, drive) - flows_.leaving(temperature);
  if (!unit_flows_.empty()) {
    heat -= unit_flows_.leaving(conducted(temperature));
  }
  return heat;
}

Eigen::VectorXd HeatBalance::conducted(const Eigen::VectorXd& temperature) const {
  return at_nodes(*model_.varying, &VaryingProperties::conductivity, temperature, integral);
}

Eigen::VectorXd HeatBalance::driven(const Eigen::VectorXd& temperature, const Drive& drive) const {
  Eigen::VectorXd heat = drive.load;
  for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
    const Exchange& exchange = model_.exchanges[e];
    Eigen::Index row = 0;
    for (const NodeId node : exchange.on.nodes) {
      heat[node.value()] += exchanged_heat(exchange.law, drive.exchanges[e], row++, temperature[node.value()]);
    }
  }
  return heat;
}

Eigen::VectorXd HeatBalance::heating_at(const std::vector<NodeId>& nodes, const Eigen::VectorXd& temperature,
                                        const Drive& drive, const TangentPoint* tangent) const {
  Eigen::VectorXd heat(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    heat[static_cast<Eigen::Index>(i)] = drive.load[nodes[i].value()] - flows_.leaving(nodes[i], temperature);
  }
  if (!unit_flows_.empty()) {
    Eigen::VectorXd phi = conducted(tangent == nullptr ? temperature : tangent->temperature);
    if (tangent != nullptr) {
      const Eigen::VectorXd slope = at_nodes(*model_.varying, &VaryingProperties::conductivity, tangent->temperature, value);
      phi += slope.cwiseProduct(temperature - tangent->temperature);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) heat[static_cast<Eigen::Index>(i)] -= unit_flows_.leaving(nodes[i], phi);
  }
  for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
    const Exchange& exchange = model_.exchanges[e];
    Eigen::Index row = 0;
    for (const NodeId node : exchange.on.nodes) {
      const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
      if (found != nodes.end() && *found == node) {
        heat[found - nodes.begin()] += exchanged_at(exchange, e, row, temperature, drive, tangent);
      }
      ++row;
    }
  }
  return heat;
}

Eigen::VectorXd HeatBalance::stored(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  if (!model_.varying) return model_.capacity.cwiseProduct(to - from);
  const auto heat = &VaryingProperties::specific_heat;
  const Eigen::VectorXd before = at_nodes(*model_.varying, heat, from, integral);
  return model_.varying->mass.cwiseProduct(at_nodes(*model_.varying, heat, to, integral) - before);
}

Eigen::VectorXd HeatBalance::largest_stored(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  if (!model_.varying) return model_.capacity.cwiseProduct(from.cwiseAbs().cwiseMax(to.cwiseAbs()));
  const auto heat = &VaryingProperties::specific_heat;
  return model_.varying->mass.cwiseProduct(at_rows(*model_.varying, heat, [&](const Curve& curve, Eigen::Index row) {
    return std::max(std::abs(integral(curve, from[row])), std::abs(integral(curve, to[row])));
  }));
}

double HeatBalance::stored_at(NodeId node, const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  const int row = node.value();
  if (!model_.varying) return model_.capacity[row] * (to[row] - from[row]);
  const Curve& heat = model_.varying->specific_heat[model_.varying->material[node]];
  return model_.varying->mass[row] * (integral(heat, to[row]) - integral(heat, from[row]));
}

double HeatBalance::stored_in_all(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  return model_.varying ? stored(from, to).sum() : model_.capacity.cwiseProduct(to - from).sum();
}

Eigen::VectorXd HeatBalance::temperature_after(const Eigen::VectorXd& from, const Eigen::VectorXd& heat,
                                               const Eigen::VectorXd& guess) const {
  if (!model_.varying) return from + heat.cwiseQuotient(model_.capacity);
  const VaryingProperties& properties = *model_.varying;
  return at_rows(properties, &VaryingProperties::specific_heat, [&](const Curve& specific_heat, Eigen::Index row) {
    return integrated_to(specific_heat, from[row], heat[row] / properties.mass[row], guess[row]);
  });
}

Eigen::VectorXd loss_to_surroundings(const HeatModel& model, const Eigen::VectorXd& temperature, const Drive& drive) {
  Eigen::VectorXd loss = Eigen::VectorXd::Zero(temperature.size());
  for (std::size_t e = 0; e < model.exchanges.size(); ++e) {
    const Exchange& exchange = model.exchanges[e];
    Eigen::Index row = 0;
    for (const NodeId node : exchange.on.nodes) {
      loss[node.value()] += exchange_slope(exchange.law, drive.exchanges[e], row++, temperature[node.value()]);
    }
  }
  return loss;
}

Eigen::VectorXd capacity_at(const HeatModel& model, const Eigen::VectorXd& temperature) {
  if (!model.varying) return model.capacity;
  const VaryingProperties& properties = *model.varying;
  return properties.mass.cwiseProduct(at_nodes(properties, &VaryingProperties::specific_heat, temperature, value));
}

Eigen::VectorXd capacity_slope_at(const HeatModel& model, const Eigen::VectorXd& temperature) {
  if (!model.varying) return Eigen::VectorXd::Zero(temperature.size());
  return at_nodes(*model.varying, &VaryingProperties::specific_heat, temperature,
                  [](const Curve& curve, double at) { return curve.slope(at) / value(curve, at); });
}

namespace {

// Whether a curve is far from one value between two temperatures, or has a kink there, as at a table's row, that puts what it
// makes of a heat or a flow off by more than `least` [K]: what its mean is off Simpson's rule.
bool bends(const Curve& curve, double from, double to, double least) {
  constexpr double unlike_ends = 1.5;  // times
  constexpr double unlike_mean = 0.1;  // of the mean of the ends
  const double first = value(curve, from), last = value(curve, to);
  const double middle = 0.5 * (first + last), mean = (integral(curve, to) - integral(curve, from)) / (to - from);
  const bool steep = std::max(first, last) > unlike_ends * std::min(first, last);
  if (steep || std::abs(mean - middle) > unlike_mean * middle) return true;
  const double simpson = (first + 4 * value(curve, 0.5 * (from + to)) + last) / 6;
  return std::abs((mean - simpson) * (to - from)) > least * mean;
}

// Of any node that gets warmer or colder by more than `least` [K].
bool any_bends(const HeatModel& model, CurveLists curves, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
               double least) {
  if (!model.varying) return false;
  const auto one_bends = [&](const Curve& curve, Eigen::Index row) -> double {
    if (curve.constant() || !(std::abs(to[row] - from[row]) > least)) return 0;
    return bends(curve, from[row], to[row], least) ? 1 : 0;
  };
  return at_rows(*model.varying, curves, one_bends).maxCoeff() > 0;
}

}  // namespace

bool capacity_bends_on_the_way(const HeatModel& model, const Eigen::VectorXd& from, const Eigen::VectorXd& to, double least) {
  return any_bends(model, &VaryingProperties::specific_heat, from, to, least);
}

bool conductivity_bends_on_the_way(const HeatModel& model, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                   double least) {
  return any_bends(model, &VaryingProperties::conductivity, from, to, least);
}

Linearised HeatBalance::linearised(const Eigen::VectorXd& temperature, const Drive& drive) const {
  Linearised result;
  result.capacity = capacity_at(model_, temperature);
  if (!unit_flows_.empty()) {
    result.conductivity = at_nodes(*model_.varying, &VaryingProperties::conductivity, temperature, value);
  }
  result.loss = loss_to_surroundings(model_, temperature, drive);
  return result;
}

Eigen::VectorXd HeatBalance::lost(const Eigen::VectorXd& change, const Linearised& at) const {
  Eigen::VectorXd heat = flows_.leaving(change) + at.loss.cwiseProduct(change);
  if (!unit_flows_.empty()) heat += unit_flows_.leaving(at.conductivity.cwiseProduct(change));
  return heat;
}

HeatBalance::Exchanged HeatBalance::exchanged(std::size_t exchange, const Eigen::VectorXd& temperature, const Drive& drive,
                                              const TangentPoint* tangent) const {
  const Exchange& with = model_.exchanges[exchange];
  Exchanged all;
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(with.on.nodes.size()); ++i) {
    const double heat = exchanged_at(with, exchange, i, temperature, drive, tangent);
    all.heat += heat;
    all.size += std::abs(heat);
  }
  return all;
}

double HeatBalance::lost_to(std::size_t exchange, const Eigen::VectorXd& change, const TangentPoint& at) const {
  const Exchange& with = model_.exchanges[exchange];
  double heat = 0;
  Eigen::Index i = 0;
  for (const NodeId node : with.on.nodes) {
    const int row = node.value();
    heat += exchange_slope(with.law, at.drive.exchanges[exchange], i++, at.temperature[row]) * change[row];
  }
  return heat;
}

}  // namespace scree::thermal
