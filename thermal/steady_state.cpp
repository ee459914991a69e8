// Newton's iteration on F(T) = 0 at the free nodes, with a line search on the sum of |F|.
//
// Where heat is radiated it starts from above: F falls ever faster with T, so that from there the iteration comes down without
// overshooting, by a quarter at least of what the radiation is too hot. From below the first step would overshoot by
// (T_end/T_0)^3.
//
// Where joints are so stiff that a rounding of T carries much heat through them, no T balances. The ledger's flows are those at
// T + T', T' being the change below rounding that does.
#include "thermal/steady_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "thermal/anchors.h"
#include "thermal/exchange.h"
#include "thermal/heat_solver.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

constexpr int most_iterations = 200;
constexpr int most_halvings = 30;
constexpr double left_of_turnover = 1e-13;
constexpr double rounding = 1e-12;  // of a temperature

class SteadySolver {
 public:
  SteadySolver(const HeatModel& model, LinearSolver solver)
      : model_(model),
        drives_(model),
        drive_(drives_.at(0)),
        balance_(model),
        free_(model),
        solver_(model, free_, solver, is_symmetric(model) ? use_of_steady_state : use_of_unsymmetric_steady_state) {}

  [[nodiscard]] std::string words() const { return fmt::format("steady state; {} ({})", solver_.name(), solver_.chosen().why); }

  HeatState solve() {
    HeatState state;
    state.given.include(drive_.fixed);
    for (const ExchangeRates& rates : drive_.exchanges) state.given.include(rates.surroundings);
    state.temperature = first_guess(state.given.largest);
    Eigen::VectorXd heating = free_heating(state.temperature);
    double moved = 0;
    double gained = 0;
    while (!converged(state.temperature, heating, moved, gained)) {
      if (state.steps == most_iterations) refuse(state.temperature, heating);
      solver_.prepare_steady(balance_.linearised(state.temperature, drive_));
      const double before = heating.lpNorm<1>();
      moved = take(free_.scatter(change_for(heating)), state.temperature, heating);
      gained = heating.lpNorm<1>() / before;
      ++state.steps;
    }
    state.factorisations = solver_.factorisations();
    state.error = Eigen::VectorXd::Zero(state.temperature.size());
    state.reached.include(state.temperature);
    state.ledger = flows(state.temperature, below_rounding(state.temperature, heating));
    if (model_.lumped) {
      LumpingEstimate estimate(model_);
      state.lumping = estimate.start();
      state.lumping.largest = 0;  // the start is forgotten
      TemperatureRange range = state.reached;
      range.include(state.given);
      estimate.advance(state.temperature, drive_, std::numeric_limits<double>::infinity(), range, state.lumping);
    }
    return state;
  }

 private:
  [[nodiscard]] Eigen::VectorXd free_heating(const Eigen::VectorXd& temperature) const {
    return free_.gather(balance_.heating(temperature, drive_));
  }

  // The initial temperatures, or one that the radiating surfaces hardly exceed.
  [[nodiscard]] Eigen::VectorXd first_guess(double largest_given) const {
    double radiating = 0;  // [W/K4]
    for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
      if (model_.exchanges[e].law == Exchange::Law::radiation) radiating += drive_.exchanges[e].factor.sum();
    }
    if (radiating == 0) return held(model_, model_.initial, drive_);
    const double applied = drive_.load.cwiseMax(0.0).sum();
    return nearest_sound(std::pow(std::pow(largest_given, 4) + applied / radiating, 0.25), largest_given);
  }

  // Where little radiates that is far hotter than the state, and a formula may have no value there: halfway back then.
  [[nodiscard]] Eigen::VectorXd nearest_sound(double hot, double given) const {
    for (int halving = 0;; ++halving, hot = 0.5 * (hot + given)) {
      Eigen::VectorXd guess = held(model_, Eigen::VectorXd::Constant(model_.initial.size(), hot), drive_);
      try {
        [[maybe_unused]] const Linearised asked = balance_.linearised(guess, drive_);
        return guess;
      } catch (const InputError&) {
        if (halving == most_halvings) throw;
      }
    }
  }

  // What is not linear is corrected again.
  [[nodiscard]] Eigen::VectorXd change_for(const Eigen::VectorXd& heating) const {
    const bool corrected = solver_.iterates() && !has_constant_properties(model_);
    return corrected ? solver_.estimate(heating) : solver_.solve(heating);
  }

  // The whole of the change, or as much as brings the balance nearer; says how far that is [K].
  double take(const Eigen::VectorXd& change, Eigen::VectorXd& temperature, Eigen::VectorXd& heating) const {
    double share = largest_share(change, temperature);
    const double before = heating.lpNorm<1>();
    for (int halving = 0; halving <= most_halvings; ++halving, share /= 2) {
      const Eigen::VectorXd tried = temperature + share * change;
      const Eigen::VectorXd then = free_heating(tried);
      if (!(then.lpNorm<1>() < before) && halving < most_halvings && share * change.lpNorm<Eigen::Infinity>() > rounding) {
        continue;
      }
      temperature = tried;
      heating = then;
      break;
    }
    return share * change.lpNorm<Eigen::Infinity>();
  }

  // That leaves every node above 0 K: below it a formula may have no value.
  [[nodiscard]] double largest_share(const Eigen::VectorXd& change, const Eigen::VectorXd& temperature) const {
    constexpr double most_cooled = 0.75;
    double share = 1;
    if (has_constant_properties(model_)) return share;
    for (Eigen::Index i = 0; i < change.size(); ++i) {
      if (temperature[i] > 0 && temperature[i] + change[i] <= 0)
        share = std::min(share, most_cooled * temperature[i] / -change[i]);
    }
    return share;
  }

  [[nodiscard]] bool converged(const Eigen::VectorXd& temperature, const Eigen::VectorXd& heating, double moved,
                               double gained) const {
    if (balanced(temperature, heating)) return true;
    const bool settled = moved > 0 && moved <= rounding * temperature.lpNorm<Eigen::Infinity>();
    return settled && gained > 0.1;
  }

  [[nodiscard]] bool balanced(const Eigen::VectorXd& temperature, const Eigen::VectorXd& heating) const {
    return heating.lpNorm<1>() <= left_of_turnover * flows(temperature).turnover;
  }

  // The change that balances what no temperature does; of no size if one does.
  Eigen::VectorXd below_rounding(const Eigen::VectorXd& temperature, const Eigen::VectorXd& heating) {
    constexpr int most_corrections = 5;
    if (balanced(temperature, heating)) return {};
    const Linearised at = balance_.linearised(temperature, drive_);
    solver_.prepare_steady(at);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(temperature.size());
    Eigen::VectorXd left = heating;
    for (int correction = 0; correction < most_corrections && !balanced(temperature, left); ++correction) {
      change += free_.scatter(solver_.solve(left));
      left = heating - Eigen::VectorXd(free_.gather(balance_.lost(change, at)));
    }
    return change;
  }

  // At a temperature, or that and a change below its rounding.
  [[nodiscard]] Ledger flows(const Eigen::VectorXd& temperature, const Eigen::VectorXd& change = {}) const {
    Ledger ledger;
    ledger.by_boundary.assign(model_.holds.size(), 0.0);
    Eigen::VectorXd heating = balance_.heating(temperature, drive_);
    if (change.size() > 0) heating -= balance_.lost(change, balance_.linearised(temperature, drive_));
    for (std::size_t i = 0; i < model_.fixed_nodes.size(); ++i) {
      const double heat = heating[model_.fixed_nodes[i].value()];
      ledger.by_boundary[model_.fixed_hold[i]] -= heat;
      ledger.turnover += std::abs(heat);
    }
    ledger.by_applied = drive_.by_load;
    for (std::size_t e = 0; e < model_.exchanges.size(); ++e) {
      const auto [heat, size] = balance_.exchanged(e, temperature, drive_);
      const double lost = change.size() > 0 ? balance_.lost_to(e, change, {temperature, drive_}) : 0;
      ledger.by_surroundings.push_back(heat - lost);
      ledger.turnover += size;
    }
    ledger.turnover += drive_.load_sizes.sum();
    return ledger;
  }

  [[noreturn]] void refuse(const Eigen::VectorXd& temperature, const Eigen::VectorXd& heating) const {
    throw RunError(fmt::format(
        "The steady state was not found: after {} iterations {:.3g} W of {:.3g} W do not balance, at "
        "temperatures from {:g} to {:g} K. Look at properties that change abruptly with temperature, or run "
        "in time to the steady state",
        most_iterations, heating.lpNorm<1>(), flows(temperature).turnover, temperature.minCoeff(), temperature.maxCoeff()));
  }

  const HeatModel& model_;
  Drives drives_;
  const Drive& drive_;
  HeatBalance balance_;
  FreeNodes free_;
  HeatSolver solver_;
};

}  // namespace

void check_steady(const HeatModel& model) {
  if (Drives(model).vary()) {
    throw InputError(problem("heat.steady", "true", "must have temperatures, flows and coefficients that do not change in time",
                             "Leave the time out of expressions and tables, or run in time"));
  }
  check_anchors(model);
}

SteadyState find_steady_state(const HeatModel& model, LinearSolver solver) {
  check_steady(model);
  SteadySolver steady(model, solver);
  return {steady.solve(), steady.words()};
}

HeatState steady_state(const HeatModel& model) {
  return find_steady_state(model, LinearSolver::automatic).state;
}

}  // namespace scree::thermal
