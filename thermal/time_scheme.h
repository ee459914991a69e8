// What one step of a time scheme does to dH/dt = F(T, t), for constant properties C dT/dt = Q - K T.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/made_meanwhile.h"
#include "thermal/drive_defect.h"
#include "thermal/flow_network.h"
#include "thermal/matrix_origin.h"
#include "thermal/solver_cost.h"
#include "thermal/stable_step.h"
#include "thermal/temperature_range.h"

namespace scree::thermal {

// Where a step begins.
struct Instant {
  double time = 0;              // [s]
  Eigen::VectorXd temperature;  // fixed nodes at their temperature of this time [K]
  Eigen::VectorXd error;        // estimate of the global error [K]
  Eigen::VectorXd rate{};       // of the temperatures in the step before; of no size if it is not known [K/s]
  TemperatureRange reached{};   // so far, if that is known
  double negligible = 0;        // what an estimate need not see of how a curve bends within the step [K]
};

// The flows of a step are a weighted mean of those at its stages: heat content changes by exactly that, which is why the
// ledger closes. What it reads are the temperatures of ledger_nodes(); the others may be anything.
struct Stage {
  double weight = 1;                // they add up to 1
  double time = 0;                  // [s]
  Eigen::VectorXd temperature;      // [K]
  std::optional<double> tangent{};  // when the step began, if its flows are those of the tangent there [s]
};

struct Step {
  Eigen::VectorXd change;  // of the temperature [K]
  Eigen::VectorXd error;   // global error after the step, per node; zero at fixed nodes [K]
  std::vector<Stage> stages;
  Eigen::VectorXd local;  // this step's own contribution to the error, per node; of no size if it was not solved [K]
};

// A one-step scheme with its estimate of the global error. Beside the temperatures T a scheme follows, in exact arithmetic, a
// second solution V of one order more; error = T - V. Kept as the difference, that is: the error is carried by the scheme's
// own (linearised) operator, and each step adds the difference between the two schemes applied to V.
class TimeScheme {
 public:
  virtual ~TimeScheme() = default;

  // Of one that is too long to be solved there is no local error.
  virtual Step step(const Instant& from, double length) = 0;

  // A step whose local error is about `allowed` [K] from a state whose past is unknown [s]; infinite if nothing changes.
  virtual double first_step(const Instant& from, double allowed) = 0;

  // How V sums what drives it over a step: what the estimate takes for the drive's integral (drive_defect.h).
  [[nodiscard]] virtual std::vector<Look> drive_quadrature(double length) const = 0;

  // Threads that are at work for it while it takes a step of that length, beside those in use.
  [[nodiscard]] virtual int threads_beside(double /*length*/) const { return 0; }

  // What a scheme keeps from one step to the next beside the state, and how it takes that up again.
  [[nodiscard]] virtual MatrixOrigin matrix_origin() const { return {}; }
  virtual void take_matrix(const MatrixOrigin& /*origin*/) {}

  // What the estimated error is multiplied with so as to bound the true one.
  [[nodiscard]] virtual double safety() const = 0;
  [[nodiscard]] virtual std::int64_t factorisations() const { return 0; }
  // What its flows need to be summed in.
  [[nodiscard]] virtual Sums sums() const { return Sums::extended; }
  // What a step costs grows as this power of its length.
  [[nodiscard]] virtual double cost_exponent() const { return 0; }
  // What solves its equations; without a reason for a scheme that solves none.
  [[nodiscard]] virtual ChosenSolver solver() const { return {}; }
  [[nodiscard]] virtual std::string name() const = 0;

 protected:
  TimeScheme() = default;
  TimeScheme(const TimeScheme&) = default;
  TimeScheme& operator=(const TimeScheme&) = default;
};

// All refer to the model. The implicit scheme, linear where the properties are constant.
std::unique_ptr<TimeScheme> make_implicit_scheme(const HeatModel& model, LinearSolver solver = LinearSolver::automatic,
                                                 const CostOfRun& run = SolverUse{});
std::unique_ptr<TimeScheme> make_linear_scheme(const HeatModel& model, LinearSolver solver = LinearSolver::automatic,
                                               const CostOfRun& run = SolverUse{});
std::unique_ptr<TimeScheme> make_enthalpy_scheme(const HeatModel& model, LinearSolver solver = LinearSolver::automatic,
                                                 const CostOfRun& run = SolverUse{});
// Throws InputError for a model that it cannot do.
std::unique_ptr<TimeScheme> make_explicit_scheme(const HeatModel& model);
// In fourth order conditions must stay and all must be linear. `stable`: those of the model, if they are known already.
std::unique_ptr<TimeScheme> make_stabilised_scheme(const HeatModel& model, std::optional<StableSteps> stable = {});

// An implicit scheme for what is longer than other steps of the same model.
struct LongSteps {
  std::unique_ptr<TimeScheme> scheme;
  double longest_short = 0;  // of the others; infinite if there are no long ones [s]
  std::string why = {};      // so long, in words
};
// Does not wait for the long steps before one is longer than `surely_short` [s].
std::unique_ptr<TimeScheme> make_mixed_scheme(std::unique_ptr<TimeScheme> of_short, MadeMeanwhile<LongSteps> of_long,
                                              double surely_short = 0);

// The nodes whose temperatures decide what passes to and from the outside: fixed ones, those joined to them (and in fourth
// order those joined to these), and those that exchange heat with surroundings. Ascending.
std::vector<NodeId> ledger_nodes(const HeatModel& model);

}  // namespace scree::thermal
