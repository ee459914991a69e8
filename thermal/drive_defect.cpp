#include "thermal/drive_defect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "thermal/evaluated.h"
#include "thermal/exchange.h"

namespace scree::thermal {

namespace {

// The midpoint rule with a correction for the slopes at both ends, by parabolas: exact for cubics.
constexpr int many = 16;
constexpr std::array<Look, many> many_looks = [] {
  std::array<Look, many> at{};
  for (int i = 0; i < many; ++i) at[i] = {(i + 0.5) / many, 1.0 / many};
  constexpr std::array correction{2.0 / 24, -3.0 / 24, 1.0 / 24};
  for (std::size_t i = 0; i < correction.size(); ++i) {
    at[i].weight += correction[i] / many;
    at[many - 1 - i].weight += correction[i] / many;
  }
  return at;
}();

constexpr double off_middle = 0.38729833462074170;  // sqrt(0.6) / 2
constexpr std::array<Look, 3> gauss_looks{{{0.5 - off_middle, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + off_middle, 5.0 / 18}}};

class Defect {
 public:
  Defect(const std::vector<Look>& quadrature, const LookedAt& step)
      : quadrature_(quadrature), step_(step), of_places_(many_looks) {
    if (step.smooth) of_places_ = gauss_looks;
  }

  // Of f(t): the quadrature's less the integral. What is the same everywhere costs little, however often it is looked at.
  template <class Value>
  double operator()(bool varies_in_place, const Value& f) const {
    const std::span<const Look> looks = varies_in_place ? of_places_ : many_looks;
    std::array<double, many> values;
    double integral = 0;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      values[i] = f(time(looks[i]));
      integral += looks[i].weight * values[i];
    }
    double defect = -integral;
    for (const Look& look : quadrature_) defect += look.weight * f(time(look));
    if (!varies_in_place) defect += std::copysign(doubt(f(step_.begin), values, f(step_.begin + step_.length)), defect);
    return step_.length * defect;
  }

 private:
  [[nodiscard]] double time(const Look& look) const { return step_.begin + look.part * step_.length; }

  // What jumps or rises steeply may do so by half of the way between two looks earlier or later. `begin`, `end`: at the step's.
  static double doubt(double begin, const std::array<double, many>& values, double end) {
    double largest = std::max(std::abs(begin - 1.5 * values[0] + 0.5 * values[1]),
                              std::abs(end - 1.5 * values[many - 1] + 0.5 * values[many - 2]));
    for (std::size_t i = 1; i + 1 < many; ++i) {
      largest = std::max(largest, std::abs(values[i - 1] - 2 * values[i] + values[i + 1]));
    }
    return 0.5 * largest / many;
  }

  const std::vector<Look>& quadrature_;
  const LookedAt& step_;
  std::span<const Look> of_places_;  // for the integral of what varies in place
};

// Heat that is missed [J].
class MissedHeat {
 public:
  MissedHeat(const LookedAt& step, const Eigen::VectorXd& capacity)
      : step_(step), capacity_(capacity), heat_(Eigen::VectorXd::Zero(capacity.size())) {}

  // missed(i) for a share of one at node i of those.
  template <class Missed>
  void add(const NodeShares& on, bool varies_in_place, const Missed& missed) {
    if (step_.smooth && varies_in_place && is_negligible(on, missed)) return;
    for (std::size_t i = 0; i < on.nodes.size(); ++i) heat_[on.nodes[i].value()] += on.shares[i] * missed(i);
  }

  [[nodiscard]] Eigen::VectorXd& heat() { return heat_; }

 private:
  template <class Missed>
  [[nodiscard]] bool is_negligible(const NodeShares& on, const Missed& missed) const {
    constexpr std::size_t most_places = 16;
    const std::size_t count = std::min(on.nodes.size(), most_places);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = k * on.nodes.size() / count;
      if (std::abs(on.shares[i] * missed(i)) > step_.negligible * capacity_[on.nodes[i].value()]) return false;
    }
    return true;
  }

  const LookedAt& step_;
  const Eigen::VectorXd& capacity_;
  Eigen::VectorXd heat_;
};

void add(const Load& load, const Defect& defect, MissedHeat& heat) {
  if (!varies_in_time(load)) return;
  const bool varies_in_place = load.density.varies_in_place();
  Evaluated missed(varies_in_place, [&](const Eigen::Vector3d& place) {
    return defect(varies_in_place, [&](double time) { return load.density(place, time); });
  });
  heat.add(load.on, varies_in_place, [&](std::size_t i) { return missed(load.on.places.col(static_cast<Eigen::Index>(i))); });
}

// By how much more held temperatures count, in the order of the fixed nodes [K s].
Eigen::VectorXd missed_of_held(const HeatModel& model, const Defect& defect) {
  const auto missed_by = [&](const Hold& hold) {
    const bool varies_in_place = hold.temperature.varies_in_place();
    return Evaluated(varies_in_place, [&, varies_in_place](const Eigen::Vector3d& place) {
      return defect(varies_in_place, [&](double time) { return hold.temperature(place, time); });
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
void add(const Exchange& exchange, const Defect& defect, const Eigen::VectorXd& temperature, MissedHeat& heat) {
  if (!varies_in_time(exchange)) return;
  const Function& coefficient = exchange.coefficient;
  const Function& surroundings = exchange.surroundings;
  const bool varies_in_place = coefficient.varies_in_place() || surroundings.varies_in_place();
  const auto potential = [&](double t) {
    return exchange.law == Exchange::Law::convection ? t : stefan_boltzmann * t * t * t * std::abs(t);
  };
  Evaluated incoming(varies_in_place, [&](const Eigen::Vector3d& place) {
    return defect(varies_in_place,
                  [&](double time) { return coefficient(place, time) * potential(surroundings(place, time)); });
  });
  Evaluated outgoing(varies_in_place, [&](const Eigen::Vector3d& place) {
    return defect(varies_in_place, [&](double time) { return coefficient(place, time); });
  });
  heat.add(exchange.on, varies_in_place, [&](std::size_t i) {
    const Eigen::Vector3d place = exchange.on.places.col(static_cast<Eigen::Index>(i));
    return incoming(place) - outgoing(place) * potential(temperature[exchange.on.nodes[i].value()]);
  });
}

}  // namespace

DriveDefect drive_defect(const HeatModel& model, const std::vector<Look>& quadrature, const LookedAt& step,
                         const Eigen::VectorXd& temperature, const Eigen::VectorXd& capacity) {
  const Defect defect(quadrature, step);
  MissedHeat missed(step, capacity);
  for (const Load& load : model.loads) add(load, defect, missed);
  for (const Exchange& exchange : model.exchanges) add(exchange, defect, temperature, missed);
  for (const NodeId node : model.fixed_nodes) missed.heat()[node.value()] = 0;
  return {missed.heat().cwiseQuotient(capacity), missed_of_held(model, defect) / step.length};
}

}  // namespace scree::thermal
