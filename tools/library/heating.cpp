#include "tools/library/heating.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "thermal/steady_state.h"
#include "tools/run/packing_stage.h"

namespace scree {

namespace {

[[noreturn]] void refuse(const Scene& scene, const std::string& key, const std::string& value, const std::string& rule,
                         const std::string& suggestion) {
  Problem problem;
  problem.where.file = scene.file.string();
  problem.key = key;
  problem.value = value;
  problem.rule = rule;
  problem.suggestion = suggestion;
  throw InputError(problem);
}

}  // namespace

template <int dim>
Heating<dim>::Heating(Scene scene, const packing::Packing<dim>& packing) : scene_(std::move(scene)) {
  if (!scene_.heat) refuse(scene_, "heat", "missing", "the scene must say how it is heated", "");
  auto bodies = run::adopted_bodies(scene_, packing);
  pile_ = run::placed_pile(scene_, packing);
  pile_.mesh.bodies = std::move(bodies);
  run::join(scene_, pile_);
  model_ = run::heat_model(scene_, pile_);
  if (scene_.heat->time.steady) {
    steady_ = thermal::find_steady_state(*model_, scene_.heat->time.solver).state;
  } else {
    run_.emplace(model_, scene_.heat->time, std::nullopt);
  }
}

template <int dim>
void Heating<dim>::advance_to(double time, const Progress& progress) {
  check_it_goes_on();
  if (!(time >= state().time)) {
    refuse(scene_, "the time", fmt::format("{:g} s", time), fmt::format("must be at least {:g} s, the present", state().time),
           "");
  }
  if (time > state().time) run_->advance_to(time, progress);
}

template <int dim>
void Heating<dim>::follow(const AtOutput& at_output, const Progress& progress) {
  check_it_goes_on();
  const auto read_probes = [&](const thermal::HeatRun::Output& output) {
    const Eigen::VectorXd of_nodes = model_->rows.to_nodes(output.temperature);
    std::vector<double> values;
    for (const auto& probe : pile_.probes) values.push_back(output::value_at(probe, of_nodes));
    at_output(output.time, values);
  };
  run_->follow(read_probes, progress);
}

template <int dim>
void Heating<dim>::check_it_goes_on() const {
  if (!run_) refuse(scene_, "heat.until", "steady", "a steady state has no time to advance to", "");
}

template <int dim>
Eigen::VectorXd Heating<dim>::temperature() const {
  return model_->rows.to_nodes(state().temperature);
}

template <int dim>
double Heating<dim>::probe(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& probe : pile_.probes) {
    if (probe.name == name) return output::value_at(probe, temperature());
    names.push_back(probe.name);
  }
  refuse(scene_, "a probe", name, "must be one of the scene's", suggest(name, names));
}

template <int dim>
std::vector<double> Heating<dim>::contact_flows() const {
  return thermal::contact_flows(pile_.contacts, pile_.joints, temperature(), scene_.heat->joint.form);
}

template class Heating<2>;
template class Heating<3>;

}  // namespace scree
