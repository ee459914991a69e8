// A packing that is heated, without files: advance it and look at it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "thermal/heat_run.h"
#include "tools/run/heated_pile.h"

namespace scree {

template <int dim>
class Heating {
 public:
  using Progress = thermal::HeatRun::Progress;

  // Finds the contacts and assembles the balance of heat. Throws InputError for a scene without heat, and for a
  // packing of other bodies than the scene's. A steady scene is solved here.
  Heating(Scene scene, const packing::Packing<dim>& packing);

  // To exactly `time` [s]. `progress` is told the time after every step and may throw to stop. Throws InputError for a steady
  // scene, and for a time that has passed.
  void advance_to(double time, const Progress& progress = {});

  // To the scene's end. `at_output` is told each output time from now on, the present not included, and the temperatures of the
  // probes then, in the order of pile().probes [K]. Steps may pass outputs, as in a run. Throws InputError for a steady scene.
  using AtOutput = std::function<void(double, const std::vector<double>&)>;
  void follow(const AtOutput& at_output, const Progress& progress = {});

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const run::HeatedPile<dim>& pile() const { return pile_; }
  [[nodiscard]] const thermal::HeatState& state() const { return run_ ? run_->state() : steady_; }
  [[nodiscard]] Eigen::VectorXd temperature() const;  // of every node of the mesh [K]

  [[nodiscard]] double probe(const std::string& name) const;  // [K]; throws InputError for a name that is no probe
  [[nodiscard]] std::vector<double> contact_flows() const;    // from owner to target of every contact [W]

 private:
  void check_it_goes_on() const;

  Scene scene_;
  run::HeatedPile<dim> pile_;
  std::shared_ptr<const thermal::HeatModel> model_;
  std::optional<thermal::HeatRun> run_;
  thermal::HeatState steady_;
};

}  // namespace scree
