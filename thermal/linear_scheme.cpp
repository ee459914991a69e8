// The scheme of sdirk2.h for constant properties: one matrix C + gamma h (K + B) per step size, B the convection. Loads,
// temperatures of boundaries and of surroundings may change in time.
//
// Written in increments, which keeps rounding small near a steady state: with P1 the temperatures at the step's start but the
// fixed nodes where stage 1 has them, P2 alike, and F at the times of the stages,
//   M d1 = gamma h F(P1),    M d2 = C d1 + gamma h (F(P2) - F(P1))/from_first,    T1 = P1 + d1,  T2 = P2 + d1 + from_first d2.

#include "thermal/free_nodes.h"
#include "thermal/heat_solver.h"
#include "thermal/sdirk2.h"
#include "thermal/time_scheme.h"

namespace scree::thermal {

namespace {

using namespace sdirk2;

// Of gamma h K_ii/C_i. Below it the rounding of a factorisation stays under 1e-11 of the heat.
constexpr double stiffness_of_refinement = 1e5;
constexpr int refinements = 1;

class LinearScheme : public TimeScheme {
 public:
  LinearScheme(const HeatModel& model, LinearSolver solver, const CostOfRun& run)
      : model_(model),
        drives_(model),
        balance_(model),
        free_(model),
        linear_(balance_.linearised(model.initial, drives_.at(0))),
        capacity_(free_.gather(linear_.capacity)),
        solver_(model, free_, solver, run) {}

  Step step(const Instant& from, double length) override {
    if (length != prepared_) prepare(length);
    Stage first{1 - gamma, from.time + gamma * length, {}};
    Stage last{gamma, from.time + length, {}};
    const Drive& drive0 = drives_.at(from.time);
    const Drive& drive1 = drives_.at(first.time);
    const Drive& drive2 = drives_.at(last.time);
    const Eigen::VectorXd start1 = held(model_, from.temperature, drive1);
    const Eigen::VectorXd start2 = held(model_, from.temperature, drive2);

    // Two columns: the temperatures, and the error, which nothing drives from outside.
    const double scale = gamma * length;
    Eigen::MatrixXd heat0(free_.size(), 2);  // gamma h F0
    heat0.col(0) = scale * free_.gather(balance_.heating(from.temperature, drive0));
    heat0.col(1) = -scale * free_.gather(balance_.lost(from.error, linear_));
    Eigen::MatrixXd heat1 = heat0;
    Eigen::VectorXd driven = Eigen::VectorXd::Zero(free_.size());
    if (drives_.vary()) {
      heat1.col(0) = scale * free_.gather(balance_.heating(start1, drive1));
      driven = scale * free_.gather(balance_.heating(start2, drive2)) - heat1.col(0);
    }
    const Eigen::MatrixXd d1 = solve(heat1);
    Eigen::MatrixXd rest = capacity_.asDiagonal() * d1;
    rest.col(0) += driven / from_first;
    const Eigen::MatrixXd d2 = solve(rest);

    Step result;
    const Eigen::MatrixXd change = free_.scatter(d1 + from_first * d2);
    last.temperature = start2 + change.col(0);
    result.change = last.temperature - from.temperature;
    result.local = free_.scatter(local_error(heat0, d1, d2));
    result.error = from.error + change.col(1) + result.local;
    if (drives_.vary()) {
      first.temperature = start1 + free_.scatter(d1.col(0));
      result.stages = {std::move(first), std::move(last)};
    } else {  // one evaluation of the flows instead of two, as they are linear
      result.stages = {{1, last.time, from.temperature + free_.scatter(d1.col(0) + (1 - gamma) * d2.col(0))}};
    }
    return result;
  }

  double first_step(const Instant& from, double allowed) override {
    const auto lost = [this](const Eigen::VectorXd& change) -> Eigen::VectorXd {
      return free_.gather(balance_.lost(free_.scatter(change), linear_));
    };
    const Eigen::VectorXd heating = free_.gather(balance_.heating(from.temperature, drives_.at(from.time)));
    return sdirk2::first_step(heating, capacity_, lost, allowed);
  }

  [[nodiscard]] std::vector<Look> drive_quadrature(double) const override { return sdirk2::drive_quadrature(); }
  [[nodiscard]] double safety() const override { return sdirk2::safety; }
  [[nodiscard]] ChosenSolver solver() const override { return solver_.chosen(); }
  [[nodiscard]] std::int64_t factorisations() const override { return solver_.factorisations(); }
  [[nodiscard]] std::string name() const override {
    return "SDIRK2 (L-stable, second order) with steps from the tolerance; " + solver_.name();
  }

 private:
  void prepare(double length) {
    solver_.prepare(linear_, gamma * length);
    const Eigen::VectorXd conductance = free_.gather(model_.conductance.diagonal() + linear_.loss);
    stiff_ = free_.size() > 0 && gamma * length * conductance.cwiseQuotient(capacity_).maxCoeff() > stiffness_of_refinement;
    prepared_ = length;
    whole_ = -missing(Eigen::VectorXd::Zero(free_.size()), Eigen::VectorXd::Ones(free_.size())).sum();
  }

  // A factorisation loses heat in proportion to its rounding times gamma h K/C. Where joints are much stiffer than the step is
  // short, one refinement brings it back: the residual, made of pairwise flows, knows to the bit what was lost.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& heat) const {
    if (solver_.iterates()) return iterated(heat);
    Eigen::MatrixXd change = solver_.solve(heat);
    if (!stiff_) return change;
    for (int refinement = 0; refinement < refinements; ++refinement) {
      Eigen::MatrixXd missing = heat - capacity_.asDiagonal() * change;
      for (int column = 0; column < 2; ++column) {
        missing.col(column) -= gamma * prepared_ * free_.gather(balance_.lost(free_.scatter(change.col(column)), linear_));
      }
      change += solver_.solve(missing);
    }
    return change;
  }

  // The temperatures as exactly as can be, the error to some digits. What is left of the residual's sum is heat that came from
  // nowhere: a uniform change of all temperatures puts it right, which is the best such change in the energy norm, too.
  [[nodiscard]] Eigen::MatrixXd iterated(const Eigen::MatrixXd& heat) const {
    Eigen::MatrixXd change(heat.rows(), 2);
    change.col(0) = solver_.solve(heat.col(0));
    change.col(1) = solver_.estimate(heat.col(1));
    for (int refinement = 0; stiff_ && refinement < refinements; ++refinement) {
      change.col(0) += solver_.estimate(missing(heat.col(0), change.col(0)));
    }
    const double left = missing(heat.col(0), change.col(0)).sum();
    change.col(0).array() += left / whole_;
    return change;
  }

  // Of the heat, after the change.
  [[nodiscard]] Eigen::VectorXd missing(const Eigen::VectorXd& heat, const Eigen::VectorXd& change) const {
    const Eigen::VectorXd lost = free_.gather(balance_.lost(free_.scatter(change), linear_));
    return heat - capacity_.cwiseProduct(change) - gamma * prepared_ * lost;
  }

  // Of the companion V = T - error, from gamma h F0 and the increments of both.
  [[nodiscard]] Eigen::VectorXd local_error(const Eigen::MatrixXd& heat0, const Eigen::MatrixXd& d1,
                                            const Eigen::MatrixXd& d2) const {
    const auto of_companion = [](const Eigen::MatrixXd& columns) -> Eigen::VectorXd { return columns.col(0) - columns.col(1); };
    StageHeats heats;
    heats.start = of_companion(heat0);
    heats.first = capacity_.cwiseProduct(of_companion(d1));
    heats.last = from_first * capacity_.cwiseProduct(of_companion(d2 - d1)) + heats.first;
    return sdirk2::local_error(heats, capacity_, [this](const Eigen::VectorXd& heat) { return solver_.estimate(heat); });
  }

  const HeatModel& model_;
  Drives drives_;
  HeatBalance balance_;
  FreeNodes free_;
  Linearised linear_;         // the same at all times
  Eigen::VectorXd capacity_;  // of the free nodes [J/K]
  HeatSolver solver_;
  double prepared_ = 0;  // the step the solver is prepared for [s]
  double whole_ = 0;     // the sum of all entries of M [J/K]
  bool stiff_ = false;   // whether solutions are refined
};

}  // namespace

std::unique_ptr<TimeScheme> make_linear_scheme(const HeatModel& model, LinearSolver solver, const CostOfRun& run) {
  return std::make_unique<LinearScheme>(model, solver, run);
}

}  // namespace scree::thermal
