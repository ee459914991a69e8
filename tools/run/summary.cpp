#include "tools/run/summary.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/version.h"
#include "thermal/joint_report.h"
#include "thermal/maximum_principle.h"
#include "tools/run/keys.h"
#include "tools/scene/doctor.h"
#include "tools/scene/suspicions.h"

namespace scree::run {

namespace {

// Largest ledger residual of a sound run, relative to the heat that flowed.
constexpr double largest_ledger_residual = 1e-8;

// Deeper than this part of the smaller block's size in another, contacts may have turned it the wrong way out.
constexpr double swallowed = 0.5;

// What is within the rounding of temperatures [J; W of a steady state], beside which little may have flowed: of the heat that
// the blocks hold, step after step, and of what passes between held nodes and their neighbours.
double lost_by_rounding(const thermal::HeatModel& model, const thermal::HeatState& state, bool steady) {
  const double held = model.capacity.dot(state.temperature.cwiseAbs());
  const double of_steps = held * std::sqrt(std::max(1.0, static_cast<double>(state.steps)));
  double passing = 0;  // [W]
  for (const NodeId node : model.fixed_nodes) {
    passing += std::abs(model.conductance.coeff(node.value(), node.value()) * state.temperature[node.value()]);
  }
  return std::numeric_limits<double>::epsilon() * (of_steps + passing * (steady ? 1 : state.time));
}

bool ledger_closes(const thermal::HeatState& state) {
  return state.ledger.relative_residual() <= largest_ledger_residual;
}

template <int dim>
bool is_rounding(const Scene& scene, const HeatOutcome<dim>& heat) {
  return heat.state.ledger.residual() <= lost_by_rounding(*heat.model, heat.state, scene.heat->time.steady);
}

template <int dim>
Json settle_json(const packing::Packing<dim>& packing, bool reused) {
  const packing::SettleReport& report = *packing.settled;
  Json lost = Json::array();
  for (const BlockId block : report.lost_blocks) {
    const BodyId body = packing.mesh.blocks[block].body;
    lost.push_back({{"block", block.value()}, {"body", packing.mesh.bodies[body].name}});
  }
  return {{"at_rest", report.at_rest},
          {"criterion", report.criterion},
          {"simulated_time", report.simulated_time},
          {"rms_speed", report.rms_speed},
          {"max_speed", report.max_speed},
          {"unbalanced_force", report.unbalanced_force},
          {"max_displacement", report.max_displacement},
          {"window", report.window},
          {"max_penetration", report.max_penetration},
          {"mean_penetration", report.mean_penetration},
          {"deepest_overlap", report.deepest_overlap},
          {"mean_edge", report.mean_edge},
          {"lost_blocks", report.lost_blocks.size()},
          {"lost", std::move(lost)},
          {"top", report.top},
          {"reused", reused},
          {"packing_key", packing.key}};
}

// The heat by name, of one kind.
template <class Named>
Json by_name(const std::vector<Named>& named, const std::vector<double>& heat) {
  Json entries = Json::object();
  for (std::size_t i = 0; i < named.size(); ++i) entries[named[i].name] = heat[i];
  return entries;
}

Json ledger_json(const thermal::Ledger& ledger, const thermal::HeatModel& model) {
  return {{"start_jump", ledger.start_jump},
          {"by_boundary", by_name(model.holds, ledger.by_boundary)},
          {"by_applied", by_name(model.loads, ledger.by_applied)},
          {"by_surroundings", by_name(model.exchanges, ledger.by_surroundings)},
          {"stored", ledger.stored},
          {"turnover", ledger.turnover},
          {"residual", ledger.residual()}};
}

template <int dim>
Json joints_json(const HeatOutcome<dim>& outcome, const Scene& scene) {
  const auto& pile = outcome.pile;
  const thermal::JointOptions& joint = scene.heat->joint;
  const auto temperature = outcome.model->rows.to_nodes(outcome.state.temperature);
  const auto flows = thermal::contact_flows(pile.contacts, pile.joints, temperature, joint.form);
  Json joints = Json::array();
  for (const auto& report : thermal::joint_reports(pile.mesh, scene.materials, pile.contacts, joint, flows)) {
    const auto area = outcome.overlap_areas.find({report.first, report.second});
    const double overlap_area = area == outcome.overlap_areas.end() ? 0 : area->second;
    joints.push_back({{"first", pile.mesh.bodies[report.first].name},
                      {"second", pile.mesh.bodies[report.second].name},
                      {"law", report.law},
                      {"point_face", report.point_face},
                      {"edge_edge", report.edge_edge},
                      {"overlap", report.overlap},
                      {"stiffness_factor", report.stiffness_factor},
                      {"area", report.area},
                      {"touching_area", report.touching_area},
                      {"overlap_area", overlap_area},
                      {"least_conductance", report.least_conductance},
                      {"mean_conductance", report.mean_conductance},
                      {"largest_conductance", report.largest_conductance},
                      {"joint_conductance", report.joint_conductance},
                      {"biot", report.biot},
                      {"flow", report.flow},
                      {"absolute_flow", report.absolute_flow}});
  }
  return joints;
}

template <int dim>
Json probes_json(const HeatOutcome<dim>& outcome) {
  const auto temperature = outcome.model->rows.to_nodes(outcome.state.temperature);
  Json probes = Json::object();
  for (const auto& probe : outcome.pile.probes) {
    const mesh::Block& block = outcome.pile.mesh.blocks[probe.block];
    probes[probe.name] = {{"block", outcome.pile.places.blocks[probe.block].value()},
                          {"body", outcome.pile.mesh.bodies[block.body].name},
                          {"point", std::vector<double>(probe.point.begin(), probe.point.end())},
                          {"moved", probe.moved},
                          {"temperature", output::value_at(probe, temperature)}};
    if (const auto exact = output::exact_at(probe, outcome.state.time)) probes[probe.name]["exact"] = *exact;
  }
  return probes;
}

Json lumped_json(const thermal::HeatModel& model, const thermal::LumpingError& error) {
  const thermal::BiotRange biot = thermal::biot_range(*model.lumped);
  return {{"count", model.lumped->all().size()},
          {"least_biot", biot.least},
          {"largest_biot", biot.largest},
          {"temperatures", model.capacity.size()},
          {"error", error.largest}};
}

template <int dim>
Json tensor_json(const Eigen::Matrix<double, dim, dim>& tensor) {
  Json rows = Json::array();
  for (int i = 0; i < dim; ++i) {
    Json row = Json::array();
    for (int j = 0; j < dim; ++j) row.push_back(tensor(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

template <int dim>
Json effective_json(const thermal::EffectiveConductivity<dim>& effective) {
  return {{"along", std::vector<double>(effective.along.begin(), effective.along.end())},
          {"upper", tensor_json<dim>(effective.upper)},
          {"lower", effective.lower ? tensor_json<dim>(*effective.lower) : Json()},
          {"volume_mean", effective.volume_mean},
          {"solid_fraction", effective.solid_fraction}};
}

}  // namespace

Json opening_summary(const RunContext& context) {
  const Scene& scene = context.scene;
  Json models = Json::array();
  for (const Model& model : models_of(scene)) {
    if (model.modelled) models.push_back({{"name", model.name}, {"reason", model.reason}});
  }
  return {{"status", "running"},
          {"scene", scene.file.string()},
          {"scene_hash", scene_hash(scene)},
          {"version", version()},
          {"title", scene.title},
          {"models", std::move(models)},
          {"error_estimate", context.estimate_space_error}};
}

std::string text_of(const Json& summary) {
  // A path may be of any bytes.
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const RunFiles& files, const Json& summary) {
  write_text(files.summary(), text_of(summary));
}

template <int dim>
void add_packing(Json& summary, const PackingOutcome<dim>& outcome) {
  const auto& mesh = outcome.packing.mesh;
  summary["blocks"] = mesh.blocks.size();
  summary["elements"] = mesh.elements.size();
  summary["nodes"] = mesh.nodes.size();
  if (outcome.packing.settled) summary["settle"] = settle_json(outcome.packing, outcome.reused);
}

template <int dim>
void add_heat(Json& summary, const Scene& scene, const HeatOutcome<dim>& outcome) {
  const auto& contacts = outcome.pile.contacts;
  summary["contacts"] = {{"point_face", contacts.count(contact::Kind::point_face)},
                         {"edge_edge", contacts.count(contact::Kind::edge_edge)},
                         {"overlap", contacts.count(contact::Kind::overlap)},
                         {"semi_springs", contacts.semi_springs},
                         {"semi_edges", contacts.semi_edges}};
  if (const auto& joints = outcome.pile.one_sided) {
    summary["contacts"]["one_sided"] = {{"count", joints->contacts}, {"area", joints->area}, {"tolerance", joints->tolerance}};
  }
  summary["joints"] = joints_json(outcome, scene);
  if (outcome.effective) summary["effective_conductivity"] = effective_json<dim>(*outcome.effective);
  const thermal::HeatState& state = outcome.state;
  summary["heat"] = {{"time", state.time},
                     {"ledger_residual", state.ledger.relative_residual()},
                     {"time_error", state.time_error},
                     {"tolerance", scene.heat->time.tolerance},
                     {"steps", state.steps},
                     {"rejected_steps", state.rejected_steps},
                     {"least_step", state.least_step},
                     {"largest_step", state.largest_step},
                     {"factorisations", state.factorisations},
                     {"solver", outcome.solver},
                     {"ledger", ledger_json(state.ledger, *outcome.model)},
                     {"probes", probes_json(outcome)},
                     {"least_temperature", state.temperature.minCoeff()},
                     {"largest_temperature", state.temperature.maxCoeff()},
                     {"least_temperature_ever", state.reached.least},
                     {"largest_temperature_ever", state.reached.largest}};
  if (scene.heat->time.steady) summary["heat"]["steady"] = true;
  for (const CoveredBoundary& boundary : outcome.covered) {
    summary["heat"]["covered_boundaries"].push_back(
        {{"name", boundary.name}, {"area", boundary.area}, {"covered_area", boundary.covered_area}});
  }
  for (const std::string& key : outcome.pile.unused_joints) summary["heat"]["unused_joints"].push_back(key);
  if (outcome.exact_error) summary["heat"]["exact_error"] = *outcome.exact_error;
  const thermal::MaximumPrinciple principle = thermal::maximum_principle(*outcome.model);
  summary["heat"]["maximum_principle"] = {{"holds", principle.reversed == 0},
                                          {"pairs", principle.pairs},
                                          {"reversed", principle.reversed},
                                          {"largest", principle.largest}};
  if (outcome.model->tied_nodes > 0) summary["heat"]["tied_nodes"] = outcome.model->tied_nodes;
  if (outcome.model->lumped) summary["heat"]["lumped_blocks"] = lumped_json(*outcome.model, state.lumping);
  if (const auto beyond = thermal::overshoot(*outcome.model, state)) summary["heat"]["overshoot"] = *beyond;
  if (outcome.space_error) {
    summary["heat"]["space_error"]["largest"] = outcome.space_error->largest;
    if (outcome.space_error->relative) summary["heat"]["space_error"]["relative"] = *outcome.space_error->relative;
  }
}

void add_stages(Json& summary, const std::vector<StageCost>& costs) {
  Json stages = Json::array();
  for (const StageCost& cost : costs) {
    stages.push_back({{"name", cost.name}, {"wall_seconds", cost.wall_seconds}, {"peak_memory_bytes", cost.peak_memory_bytes}});
  }
  summary["stages"] = std::move(stages);
}

template <int dim>
std::vector<std::string> unsound(const Scene& scene, const packing::Packing<dim>& packing) {
  // Whoever names a packing file accepts it as it is; its figures stand in the summary.
  if (!scene.settle || !packing.settled) return {};
  const packing::SettleReport& report = *packing.settled;
  const mesh::BlockMesh<dim>& mesh = packing.mesh;
  std::vector<std::string> reasons;
  const double overlap = report.max_penetration / report.mean_edge;
  if (overlap > scene.settle->largest_overlap) {
    reasons.push_back(
        fmt::format("two blocks overlap by {:.3g} of the mean edge at the end, above settle.largest_overlap of {:g}. Raise "
                    "settle.iterations or lower settle.step",
                    overlap, scene.settle->largest_overlap));
  }
  // A block that is let go late may find others where it hung, and parts from them: depth is no fault of the solver then.
  if (scene.settle->options.release_time == 0 && report.deepest_overlap > swallowed) {
    reasons.push_back(
        fmt::format("a block was pressed into another by {:.3g} of its size during the fall: one may have passed through the "
                    "other. Lower settle.step, raise settle.iterations, or make masses less unlike",
                    report.deepest_overlap));
    for (const std::string& start : overlapping_blocks(mesh, packing::Pairs::with_a_free_block))
      reasons.push_back(start + ". Move them apart");
  }
  if (const std::size_t free = free_blocks(mesh); free > 0 && report.lost_blocks.size() == free) {
    reasons.emplace_back(
        "every block that could move was lost: it fell past the lowest fixed body, or left the scene's surroundings. Put "
        "a fixed body below them, or slow them down");
    return reasons;
  }
  if (report.at_rest || scene.settle->accept_moving) return reasons;
  reasons.push_back(
      fmt::format("the pile was still moving at {:.3g} s (at rest is: {}). Raise settle.limit, {}or accept it with "
                  "settle.accept_moving",
                  report.simulated_time, report.criterion,
                  scene.settle->options.local_damping > 0 ? "" : "stop what swings by settle.local_damping, "));
  return reasons;
}

template <int dim>
std::vector<std::string> unsound(const Scene& scene, const HeatOutcome<dim>& heat) {
  const thermal::HeatState& state = heat.state;
  std::vector<std::string> reasons;
  const double tolerance = scene.heat->time.tolerance;
  if (!(state.time_error <= tolerance)) {
    reasons.push_back(
        fmt::format("the time error reached {:.3g} K, above heat.tolerance of {:.3g} K{}", state.time_error, tolerance,
                    heat.model->varying && state.factorisations == 0
                        ? ". Where a specific heat falls with temperature errors grow: heat.integrator: implicit may stay below"
                        : ""));
  }
  // Of steps in time within their error.
  if (state.reached.least < (scene.heat->time.steady ? 0 : -tolerance)) {
    reasons.push_back(
        fmt::format("temperatures fell to {:.6g} K, below 0 K: more heat was taken away than there was. Look at "
                    "negative fluxes and flows, and at overshoot on coarse meshes",
                    state.reached.least));
  }
  if (!ledger_closes(state) && !is_rounding(scene, heat)) {
    reasons.push_back(fmt::format("the energy ledger does not close: {:.2e} of the heat that flowed is missing (limit {:.0e})",
                                  state.ledger.relative_residual(), largest_ledger_residual));
  }
  return reasons;
}

template <int dim>
std::optional<std::string> hidden_by_rounding(const Scene& scene, const HeatOutcome<dim>& heat) {
  if (ledger_closes(heat.state) || !is_rounding(scene, heat)) return std::nullopt;
  return fmt::format(
      "heat: {:.2e} of the heat that flowed is missing from the ledger by rounding: so little flows beside what "
      "the blocks hold, or could pass on",
      heat.state.ledger.relative_residual());
}

template std::optional<std::string> hidden_by_rounding<2>(const Scene&, const HeatOutcome<2>&);
template std::optional<std::string> hidden_by_rounding<3>(const Scene&, const HeatOutcome<3>&);
template std::vector<std::string> unsound<2>(const Scene&, const HeatOutcome<2>&);
template std::vector<std::string> unsound<3>(const Scene&, const HeatOutcome<3>&);
template std::vector<std::string> unsound<2>(const Scene&, const packing::Packing<2>&);
template std::vector<std::string> unsound<3>(const Scene&, const packing::Packing<3>&);
template void add_packing<2>(Json&, const PackingOutcome<2>&);
template void add_packing<3>(Json&, const PackingOutcome<3>&);
template void add_heat<2>(Json&, const Scene&, const HeatOutcome<2>&);
template void add_heat<3>(Json&, const Scene&, const HeatOutcome<3>&);

}  // namespace scree::run
