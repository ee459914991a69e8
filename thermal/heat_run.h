// Temperatures in time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "thermal/between_steps.h"
#include "thermal/drive.h"
#include "thermal/heat_model.h"
#include "thermal/lumping_error.h"
#include "thermal/matrix_origin.h"
#include "thermal/step_forecast.h"
#include "thermal/temperature_range.h"

namespace scree::thermal {

// Where the heat went, all since t = 0 [J]. Each flow is integrated with the weights of the time scheme, so `residual`
// is rounding and solver error only.
struct Ledger {
  double start_jump = 0;                // to bring the fixed nodes to their temperature at t = 0
  std::vector<double> by_boundary;      // through fixed nodes, in the order of HeatModel::holds
  std::vector<double> by_applied;       // in the order of HeatModel::loads
  std::vector<double> by_surroundings;  // in the order of HeatModel::exchanges
  double stored = 0;                    // that the nodes hold more than at t = 0
  double turnover = 0;  // heat that flowed: integral of the sum of |flow| over boundaries and sources, and |start_jump|

  [[nodiscard]] double residual() const;           // |stored - all that came in| [J]
  [[nodiscard]] double relative_residual() const;  // of turnover; 0 if nothing flowed
};

// Everything a later process needs to go on as if it had never stopped.
struct HeatState {
  double time = 0;              // [s]
  Eigen::VectorXd temperature;  // one per row of the model [K]
  Eigen::VectorXd error;        // estimate of the global time error, one per row [K]
  Eigen::VectorXd rate;         // of the temperatures in the last step; of no size if no c varies or something has jumped [K/s]
  double next_step = 0;         // what the step control would take [s]
  Ledger ledger;
  double time_error = 0;  // bound on |error| at any node and any step so far, with the scheme's safety [K]
  std::int64_t steps = 0;
  std::int64_t rejected_steps = 0;
  std::int64_t factorisations = 0;
  double least_step = 0;    // [s]
  double largest_step = 0;  // [s]
  // Of all nodes after any step so far, the start included; and of the temperatures that the heat comes from: at the start,
  // of boundaries and of surroundings.
  TemperatureRange reached;
  TemperatureRange given;
  LumpingError lumping;
  MatrixOrigin matrix;
  // Ends of the steps before, but for those that are far shorter than the output interval.
  StepEnds earlier;
};

// By how much the temperatures ever left the range of those that the heat comes from [K]: conduction cannot, so this is what
// the mesh and the step make of a sudden start. Nothing where heat is applied: then they may.
std::optional<double> overshoot(const HeatModel& model, const HeatState& state);

// Keeps the model, or a copy of it. Throws InputError for options that make no sense (an explicit step above the stable one,
// named with the block that limits it) and RunError if the equations cannot be solved or the tolerance is out of reach.
class HeatRun {
 public:
  using SharedModel = std::shared_ptr<const HeatModel>;
  HeatRun(const HeatModel& model, const TimeOptions& options);  // from t = 0
  HeatRun(const HeatModel& model, const TimeOptions& options, HeatState state);
  HeatRun(SharedModel model, const TimeOptions& options, std::optional<HeatState> state);
  ~HeatRun();

  // Told the time after every step; may throw to stop. The state is then that of the last whole step.
  using Progress = std::function<void(double)>;

  // To exactly `time`, where a step ends. Steps that are shorter than `output_every` end at its multiples, longer ones at some
  // of them: a power of two of intervals is passed at once where nothing bends in between and the cubic through the ends of
  // steps tells the temperatures there within the tolerance (between_steps.h).
  void advance_to(double time, const Progress& progress = {});

  struct Output {
    double time;  // [s]
    const Eigen::VectorXd& temperature;
    // Whether it is that of state(), from which another run would go on and repeat this one to the bit.
    bool resumable;
  };
  // To the end. `at_output` is told each output from now on, the present not included.
  using AtOutput = std::function<void(const Output&)>;
  void follow(const AtOutput& at_output, const Progress& progress = {});

  [[nodiscard]] const HeatState& state() const;
  [[nodiscard]] std::string solver() const;  // in words, for the summary
  // How far the work is that steps do up to a time, for the part that is done to be told.
  [[nodiscard]] WorkDone work_done() const;
  // Whether the time error stayed within the tolerance so far.
  [[nodiscard]] bool within_tolerance() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Restart file (HDF5), whole or not there; doubles to the bit. `key` says what the state belongs to: read_state throws
// InputError for another key and for a missing or damaged file.
void write(const HeatState& state, const std::string& key, const std::filesystem::path& file);
HeatState read_state(const std::filesystem::path& file, const std::string& key);

}  // namespace scree::thermal
