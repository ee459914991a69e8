#include "thermal/drive_defect.h"

#include <cmath>

#include "thermal/evaluated.h"
#include "thermal/exchange.h"

namespace scree::thermal {

namespace {

// Times in a step at which the integral looks at what drives it: enough to know the defect of a jump to an eighth.
constexpr int looks = 16;

class Defect {
 public:
  Defect(const std::vector<Look>& quadrature, double begin, double length)
      : quadrature_(quadrature), begin_(begin), length_(length) {}

  // Of f(t): the quadrature's less the integral.
  template <class Value>
  double operator()(const Value& f) const {
    double integral = 0;
    for (int i = 0; i < looks; ++i) integral += f(begin_ + (i + 0.5) / looks * length_) / looks;
    double parabola = 0;
    for (const Look& look : quadrature_) parabola += look.weight * f(begin_ + look.part * length_);
    return length_ * (parabola - integral);
  }

 private:
  const std::vector<Look>& quadrature_;
  double begin_;
  double length_;
};

// value(place) at each node.
template <class Value>
Eigen::VectorXd at_nodes(const NodeShares& on, bool varies_in_place, const Value& value) {
  Evaluated evaluated(varies_in_place, value);
  Eigen::VectorXd values(static_cast<Eigen::Index>(on.nodes.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = evaluated(on.places.col(i));
  return values;
}

void add(const Load& load, const Defect& defect, Eigen::VectorXd& heat) {
  if (!varies_in_time(load)) return;
  const Eigen::VectorXd missed = at_nodes(load.on, load.density.varies_in_place(), [&](const Eigen::Vector3d& place) {
    return defect([&](double time) { return load.density(place, time); });
  });
  for (std::size_t i = 0; i < load.on.nodes.size(); ++i) {
    heat[load.on.nodes[i].value()] += load.on.shares[i] * missed[static_cast<Eigen::Index>(i)];
  }
}

// By how much more held temperatures count, in the order of the fixed nodes [K s].
Eigen::VectorXd missed_of_held(const HeatModel& model, const Defect& defect) {
  const auto missed_by = [&](const Hold& hold) {
    return Evaluated(hold.temperature.varies_in_place(), [&](const Eigen::Vector3d& place) {
      return defect([&](double time) { return hold.temperature(place, time); });
    });
  };
  std::vector<decltype(missed_by(model.holds.front()))> of_holds;
  for (const Hold& hold : model.holds) of_holds.push_back(missed_by(hold));
  Eigen::VectorXd missed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.fixed_nodes.size()));
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) {
    const int hold = model.fixed_hold[i];
    if (!varies_in_time(model.holds[hold])) continue;
    missed[static_cast<Eigen::Index>(i)] = of_holds[hold](model.places.col(model.fixed_nodes[i].value()));
  }
  return missed;
}

// Exchanged heat is the coefficient times the difference of a power of both temperatures, so that what is missed is made of
// two defects: that of what comes in, and that of the coefficient.
void add(const Exchange& exchange, const Defect& defect, const Eigen::VectorXd& temperature, Eigen::VectorXd& heat) {
  if (!varies_in_time(exchange)) return;
  const Function& coefficient = exchange.coefficient;
  const Function& surroundings = exchange.surroundings;
  const bool varies_in_place = coefficient.varies_in_place() || surroundings.varies_in_place();
  const auto potential = [&](double t) {
    return exchange.law == Exchange::Law::convection ? t : stefan_boltzmann * t * t * t * std::abs(t);
  };
  const Eigen::VectorXd in = at_nodes(exchange.on, varies_in_place, [&](const Eigen::Vector3d& place) {
    return defect([&](double time) { return coefficient(place, time) * potential(surroundings(place, time)); });
  });
  const Eigen::VectorXd out = at_nodes(exchange.on, varies_in_place, [&](const Eigen::Vector3d& place) {
    return defect([&](double time) { return coefficient(place, time); });
  });
  for (std::size_t i = 0; i < exchange.on.nodes.size(); ++i) {
    const auto row = exchange.on.nodes[i].value();
    const auto at = static_cast<Eigen::Index>(i);
    heat[row] += exchange.on.shares[i] * (in[at] - out[at] * potential(temperature[row]));
  }
}

}  // namespace

DriveDefect drive_defect(const HeatModel& model, const std::vector<Look>& quadrature, double begin, double length,
                         const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity) {
  const Defect defect(quadrature, begin, length);
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(temperature.size());
  for (const Load& load : model.loads) add(load, defect, heat);
  for (const Exchange& exchange : model.exchanges) add(exchange, defect, temperature, heat);
  for (const NodeId node : model.fixed_nodes) heat[node.value()] = 0;
  return {heat.cwiseQuotient(capacity), missed_of_held(model, defect) / length};
}

}  // namespace scree::thermal
