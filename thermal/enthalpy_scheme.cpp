// The scheme of sdirk2.h for properties and coefficients that change: Newton's iteration for each stage,
//   r = B + gamma h F(Y) - (H(Y) - H(T)),    Y += M^-1 r,    B = 0, then from_first (H(Y1) - H(T)),
// with one matrix M for as many steps of one length as it serves, taken at the start of the first of them, and a new one where
// the iteration converges slowly. It goes on until the residual is rounding, so that the ledger closes: what is left of r is
// heat that came from nowhere.
#include <array>
#include <limits>

#include "thermal/bent_path.h"
#include "thermal/free_nodes.h"
#include "thermal/heat_solver.h"
#include "thermal/little_change.h"
#include "thermal/sdirk2.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

using namespace sdirk2;

constexpr int most_iterations = 30;
constexpr double least_gain = 0.2;        // of an iteration, before a new matrix is worth its cost
constexpr double left_of_heat = 1e-13;    // residual, of the heat that the stage moves
constexpr double served_change = 0.02;    // of any entry of M's diagonal and of any conductivity, before M no longer serves
constexpr double estimated_change = 0.2;  // of any capacity, before M no longer serves the estimate
constexpr double near_rounding = 4;       // a residual of up to so many times what rounding leaves is taken for that
constexpr double quarter_of_a_unit = 0.25 * std::numeric_limits<double>::epsilon();

class EnthalpyScheme : public TimeScheme {
 public:
  EnthalpyScheme(const HeatModel& model, LinearSolver solver, const CostOfRun& run)
      : model_(model),
        drives_(model),
        balance_(model),
        path_(model, balance_, drives_),
        free_(model),
        solver_(model, free_, solver, run),
        conductance_(model.conductance.diagonal()),
        unit_conductance_(balance_.unit_flows().empty() ? Eigen::VectorXd() : model.varying->unit_conductance.diagonal()) {}

  Step step(const Instant& from, double length) override {
    scale_ = gamma * length;
    Stage first{1 - gamma, from.time + scale_, {}};
    Stage last{gamma, from.time + length, {}};
    first.temperature = held(model_, from.temperature, drives_.at(first.time));
    const Linearised now = balance_.linearised(first.temperature, drives_.at(first.time));
    if (!serves(now)) linearise(first, now);

    Step result;
    Eigen::VectorXd heat1 = Eigen::VectorXd::Zero(free_.size());
    if (!solve(from, heat1, first)) return result;
    heat1 = free_.gather(balance_.stored(from.temperature, first.temperature));
    last.temperature = held(model_, first.temperature, drives_.at(last.time));
    if (!solve(from, from_first * heat1, last)) return result;

    StageHeats heats;  // of the companion V = T - error, to first order in the error
    heats.start = scale_ * free_.gather(balance_.heating(from.temperature, drives_.at(from.time)));
    heats.first = heat1;
    heats.last = free_.gather(balance_.stored(from.temperature, last.temperature)) - from_first * heat1;
    const Eigen::VectorXd carried = carry(from, first, last, heats);
    const Eigen::VectorXd capacity = free_.gather(linear_.capacity);
    const Eigen::VectorXd local =
        local_error(heats, capacity, [this](const Eigen::VectorXd& heat) { return solver_.estimate(heat); });

    result.change = last.temperature - from.temperature;
    result.error = from.error + free_.scatter(carried + local);
    result.local = free_.scatter(local);
    const std::array<Stage, 2> stages{std::move(first), std::move(last)};
    if (const auto missed = path_.missed(from, length, stages, linear_.loss)) {
      const Eigen::VectorXd bent = solver_.estimate(free_.gather(*missed));
      result.error += free_.scatter(bent);
      // Both count, even where one takes off what the other adds.
      const Eigen::VectorXd signs = (local + bent).cwiseSign();
      result.local = free_.scatter(signs.cwiseProduct(local.cwiseAbs() + bent.cwiseAbs()));
    }
    result.stages = {stages.begin(), stages.end()};
    return result;
  }

  double first_step(const Instant& from, double allowed) override {
    const Drive& drive = drives_.at(from.time);
    const Linearised at = balance_.linearised(from.temperature, drive);
    const auto lost = [&](const Eigen::VectorXd& change) -> Eigen::VectorXd {
      return free_.gather(balance_.lost(free_.scatter(change), at));
    };
    return sdirk2::first_step(free_.gather(balance_.heating(from.temperature, drive)), free_.gather(at.capacity), lost,
                              allowed);
  }

  [[nodiscard]] MatrixOrigin matrix_origin() const override { return origin_; }
  void take_matrix(const MatrixOrigin& origin) override {
    if (origin.temperature.size() == 0) return;
    scale_ = origin.scale;
    linearise({1, origin.time, origin.temperature}, balance_.linearised(origin.temperature, drives_.at(origin.time)));
  }

  [[nodiscard]] std::vector<Look> drive_quadrature(double) const override { return sdirk2::drive_quadrature(); }
  [[nodiscard]] double safety() const override { return sdirk2::safety; }
  [[nodiscard]] ChosenSolver solver() const override { return solver_.chosen(); }
  [[nodiscard]] std::int64_t factorisations() const override { return solver_.factorisations(); }
  [[nodiscard]] std::string name() const override {
    return "SDIRK2 (L-stable, second order) of the enthalpy, Newton's iteration, steps from the tolerance; " + solver_.name();
  }

 private:
  void linearise(const Stage& stage, const Linearised& at) {
    linear_ = at;
    origin_ = {stage.temperature, stage.time, scale_};
    solver_.prepare(linear_, scale_);
    diagonal_ = linear_.capacity + scale_ * (conductance_ + linear_.loss);
    if (unit_conductance_.size() > 0) diagonal_ += scale_ * unit_conductance_.cwiseProduct(linear_.conductivity);
  }

  // The residual that rounding leaves [J]: a temperature is off by a quarter of a unit in its last place on average, of which
  // M's diagonal makes heat. At stiff joints it is what Newton's iteration comes to: 0.9 to 1.1 of this in the pile at beta
  // 1000 to 1e6.
  [[nodiscard]] double left_by_rounding(const Eigen::VectorXd& temperature) const {
    return quarter_of_a_unit * free_.gather(diagonal_.cwiseProduct(temperature.cwiseAbs())).sum();
  }

  // Where c or k has been far larger on the way from where its integral begins, that is what is rounded. It takes going through
  // the curves again.
  [[nodiscard]] double left_by_integrals(const Eigen::VectorXd& from, const Eigen::VectorXd& temperature) const {
    Eigen::VectorXd integrals = balance_.largest_stored(from, temperature);
    if (unit_conductance_.size() > 0)
      integrals += scale_ * unit_conductance_.cwiseProduct(balance_.conducted(temperature).cwiseAbs());
    return quarter_of_a_unit * free_.gather(integrals).sum();
  }

  // By which all free nodes alike take up so much heat [K].
  [[nodiscard]] Eigen::VectorXd change_of_all(double heat) const {
    const Eigen::VectorXd all = free_.scatter(Eigen::VectorXd::Ones(free_.size()));
    const double taken = free_.gather(linear_.capacity + scale_ * balance_.lost(all, linear_)).sum();  // [J/K]
    return heat / taken * all;
  }

  // A matrix that is 2 % off costs an iteration or two a stage, a new factor as much as ten to fifty of them; the coarse levels
  // of a multigrid no more than one.
  [[nodiscard]] bool serves(const Linearised& now) const {
    if (solver_.iterates() || origin_.scale != scale_) return false;
    const Eigen::VectorXd diagonal = now.capacity + scale_ * now.loss;
    return little_changed(diagonal, linear_.capacity + scale_ * linear_.loss, served_change) &&
           little_changed(now.conductivity, linear_.conductivity, served_change);
  }

  // From the stage's temperatures as a first guess to its solution; false if there is none to be had. `base` is B [J].
  bool solve(const Instant& from, const Eigen::VectorXd& base, Stage& stage) {
    double before = std::numeric_limits<double>::infinity();
    double sum_before = before;
    bool evened = false;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const Eigen::VectorXd stored = free_.gather(balance_.stored(from.temperature, stage.temperature));
      const Eigen::VectorXd heating = free_.gather(balance_.heating(stage.temperature, drives_.at(stage.time)));
      const Eigen::VectorXd residual = base + scale_ * heating - stored;
      const double left = residual.lpNorm<1>();
      if (!std::isfinite(left)) return false;
      const double enough = left_of_heat * (stored.lpNorm<1>() + base.lpNorm<1>());
      if (left <= enough) return true;
      // What rounding leaves is flows between neighbours, which cancel in the sum: that is what the ledger lacks. Where another
      // solution would not make it less one change of all temperatures does.
      const double sum = std::abs(residual.sum());
      const bool gains = left <= least_gain * before;
      const bool rounded = left <= near_rounding * left_by_rounding(stage.temperature) ||
                           (!gains && left <= near_rounding * left_by_integrals(from.temperature, stage.temperature));
      if (rounded && (sum <= enough || evened)) return true;
      if (rounded && sum > least_gain * sum_before) {
        stage.temperature += change_of_all(residual.sum());
        evened = true;
        continue;
      }
      if (!rounded && !gains) linearise(stage, balance_.linearised(stage.temperature, drives_.at(stage.time)));
      before = left;
      sum_before = sum;
      stage.temperature += free_.scatter(solver_.correction(residual));
      if (below_zero(from.temperature, stage.temperature)) return false;
    }
    return false;
  }

  // Whether a node is at 0 K that was above it: a formula may have no value there, and shorter steps do not get there. Below a
  // tenth of a nanokelvin no step is short enough.
  static bool below_zero(const Eigen::VectorXd& from, const Eigen::VectorXd& temperature) {
    constexpr double as_cold = 1e-10;  // [K]
    return (temperature.array() <= 0 && from.array() > as_cold).any();
  }

  // An error keeps its heat, not its temperature, where c changes. Where c does so by a multiple, as at the corners of a
  // freezing curve, M must be the one of the state that the heat is shared out by: else the error grows or falls by as much.
  void fit(const Stage& stage, const Eigen::VectorXd& capacity) {
    if (little_changed(capacity, free_.gather(linear_.capacity), estimated_change)) return;
    linearise(stage, balance_.linearised(stage.temperature, drives_.at(stage.time)));
  }

  // How the error changes over the step, and what that takes off the companion's heats.
  Eigen::VectorXd carry(const Instant& from, const Stage& first, const Stage& last, StageHeats& heats) {
    const auto capacity = [&](const Eigen::VectorXd& at) { return free_.gather(capacity_at(model_, at)); };
    const Eigen::VectorXd c0 = capacity(from.temperature), c1 = capacity(first.temperature), c2 = capacity(last.temperature);
    const Eigen::VectorXd e0 = free_.gather(from.error);
    fit(first, c1);
    const Eigen::VectorXd start = -scale_ * free_.gather(balance_.lost(from.error, linear_));
    const Eigen::VectorXd e1 = e0 + solver_.estimate(start + (c0 - c1).cwiseProduct(e0));
    const Eigen::VectorXd heat1 = c1.cwiseProduct(e1) - c0.cwiseProduct(e0);
    fit(last, c2);
    const Eigen::VectorXd e2 = e0 + solver_.estimate(start + (c0 - c2).cwiseProduct(e0) + from_first * heat1);
    heats.start -= start;
    heats.first -= heat1;
    heats.last -= c2.cwiseProduct(e2) - c0.cwiseProduct(e0) - from_first * heat1;
    return e2 - e0;
  }

  const HeatModel& model_;
  Drives drives_;
  HeatBalance balance_;
  BentPath path_;
  FreeNodes free_;
  HeatSolver solver_;
  Eigen::VectorXd conductance_;       // K_ii [W/K]
  Eigen::VectorXd unit_conductance_;  // U_ii; empty without U [m]
  Eigen::VectorXd diagonal_;          // of M [J/K]
  Linearised linear_;                 // what the solver is prepared for
  MatrixOrigin origin_;               // and where that is from
  double scale_ = 0;                  // gamma h of the step [s]
};

}  // namespace

std::unique_ptr<TimeScheme> make_enthalpy_scheme(const HeatModel& model, LinearSolver solver, const CostOfRun& run) {
  return std::make_unique<EnthalpyScheme>(model, solver, run);
}

std::unique_ptr<TimeScheme> make_implicit_scheme(const HeatModel& model, LinearSolver solver, const CostOfRun& run) {
  return has_constant_properties(model) ? make_linear_scheme(model, solver, run) : make_enthalpy_scheme(model, solver, run);
}

}  // namespace scree::thermal
