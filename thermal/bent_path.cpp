#include "thermal/bent_path.h"

#include "thermal/sdirk2.h"

namespace scree::thermal {

namespace {

constexpr int looks = 8;

// The values at the step's start and stages less the integral.
class Defect {
 public:
  void start_with(const Eigen::VectorXd& begin, const Eigen::VectorXd& first, const Eigen::VectorXd& last) {
    using namespace sdirk2;
    sum_ = (1 - parabola1 - parabola2) * begin + parabola1 * first + parabola2 * last;
  }
  void look_at(const Eigen::VectorXd& values) { sum_ -= values / looks; }
  [[nodiscard]] const Eigen::VectorXd& sum() const { return sum_; }

 private:
  Eigen::VectorXd sum_;
};

}  // namespace

BentPath::BentPath(const HeatModel& model, const HeatBalance& balance, Drives& drives)
    : model_(model),
      balance_(balance),
      drives_(drives),
      held_conductivity_bends_(!balance.unit_flows().empty() && holds_vary_in_time(model)) {}

bool BentPath::bends(const Instant& from, const std::array<Stage, 2>& stages) const {
  if (held_conductivity_bends_) return true;
  const auto between = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return capacity_bends_on_the_way(model_, a, b, from.negligible) ||
           (!balance_.unit_flows().empty() && conductivity_bends_on_the_way(model_, a, b, from.negligible));
  };
  return between(from.temperature, stages[0].temperature) || between(stages[0].temperature, stages[1].temperature);
}

std::optional<Eigen::VectorXd> BentPath::missed(const Instant& from, double length, const std::array<Stage, 2>& stages,
                                                const Eigen::VectorXd& loss) {
  if (!bends(from, stages)) return std::nullopt;
  const Eigen::VectorXd &begin = from.temperature, &first = stages[0].temperature, &last = stages[1].temperature;
  const bool conducts = !balance_.unit_flows().empty();
  Defect of_temperature, of_potential;
  of_temperature.start_with(begin, first, last);
  if (conducts) of_potential.start_with(balance_.conducted(begin), balance_.conducted(first), balance_.conducted(last));
  const Eigen::VectorXd heat1 = balance_.stored(begin, first), heat2 = balance_.stored(begin, last);
  for (int i = 0; i < looks; ++i) {
    const double s = (i + 0.5) / looks;
    const double of_first = s * (1 - s) / (sdirk2::gamma * (1 - sdirk2::gamma));
    const double of_last = s * (s - sdirk2::gamma) / (1 - sdirk2::gamma);
    const Eigen::VectorXd on_the_way =
        balance_.temperature_after(begin, of_first * heat1 + of_last * heat2, begin + s * (last - begin));
    const Eigen::VectorXd at = held(model_, on_the_way, drives_.at(from.time + s * length));
    of_temperature.look_at(at);
    if (conducts) of_potential.look_at(balance_.conducted(at));
  }
  Eigen::VectorXd left = balance_.flows().leaving(of_temperature.sum()) + loss.cwiseProduct(of_temperature.sum());
  if (conducts) left += balance_.unit_flows().leaving(of_potential.sum());
  return -length * left;
}

}  // namespace scree::thermal
