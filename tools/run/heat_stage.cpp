#include "tools/run/heat_stage.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "contact/find_contacts.h"
#include "engine/base/threads.h"
#include "engine/output/probe_history.h"
#include "thermal/steady_state.h"
#include "thermal/step_forecast.h"
#include "tools/run/begin_results.h"
#include "tools/run/packing_stage.h"
#include "tools/scene/suspicions.h"

namespace scree::run {

namespace {

std::string one_sided_words(const contact::OneSided& joints) {
  constexpr double most = 0.3;  // of an element: beyond it semi-springs reach what is no neighbour
  const double enough = 1.2 * joints.tolerance;
  return fmt::format(
      "{} semi-springs of {:.4g} m2 reach across gaps over which the finer mesh behind does not: those joints conduct half. {}",
      joints.contacts, joints.area,
      enough <= most ? fmt::format("With a contact.tolerance of some {:.2g} both sides do", enough)
                     : "Refine the coarser mesh, or lower contact.tolerance");
}

template <int dim>
HeatedPile<dim> find_pile(RunContext& context, packing::Packing<dim>& packing) {
  auto pile = placed_pile(context.scene, packing, [&](const std::string& text) { context.progress.note(text); });
  if (!is_placed(context.scene)) packing = {};  // else it is yet to be kept
  context.stage("contacts", fmt::format("{} blocks", pile.mesh.blocks.size()), [&] {
    join(context.scene, pile);
    return true;
  });
  for (const std::string& key : pile.unused_joints)
    context.remark(fmt::format("contacts: {} holds for none in this packing", key));
  if (pile.one_sided) context.remark("contacts: " + one_sided_words(*pile.one_sided));
  for (const std::string& sentence : isolated_blocks(pile.mesh, pile.contacts, context.scene)) {
    context.remark("contacts: " + sentence);
  }
  return pile;
}

// The state an interrupted run of the same heat stage left, if this run is to go on from it.
std::optional<thermal::HeatState> interrupted_state(const RunContext& context, const std::string& key) {
  if (!context.resume || !std::filesystem::exists(context.files.restart())) return std::nullopt;
  return thermal::read_state(context.files.restart(), key);
}

template <int dim>
void march(RunContext& context, thermal::HeatRun& run, HeatRecorder<dim>& recorder) {
  const double until = context.scene.heat->time.until;
  thermal::WorkDone work = run.work_done();
  const auto at_output = [&](const thermal::HeatRun::Output& output) {
    check_interrupt();  // a step may pass thousands
    output.resumable ? recorder.record(run.state()) : recorder.record_passed(output.time, output.temperature);
  };
  run.follow(at_output, [&](double time) {
    check_interrupt();
    context.progress.update(work.part(time), fmt::format("{:.4g} of {:.4g} s", time, until));
  });
  recorder.finish(context.last_files);
}

// To be called when nothing can be refused any more. What `begin` writes has its name before the first frame has.
template <int dim>
std::unique_ptr<HeatRecorder<dim>> begin_recording(RunContext& context, const std::function<void()>& begin,
                                                   const HeatOutcome<dim>& outcome, std::optional<double> from) {
  FilesTogether first;
  {
    const FilesTogether::Scope scope(first);
    begin();
  }
  if (from) first.publish();  // the first frame may be long in coming
  auto recorder = std::make_unique<HeatRecorder<dim>>(context.scene, context.files, outcome.pile, *outcome.model, from);
  recorder->publish_before_frames(first);
  if (context.estimate_space_error) recorder->estimate_space_error();
  return recorder;
}

template <int dim>
void run_in_time(RunContext& context, const std::function<void()>& begin, HeatOutcome<dim>& outcome) {
  const Scene& scene = context.scene;
  auto state = interrupted_state(context, outcome.pile.key);
  const auto from = state ? std::optional<double>(state->time) : std::nullopt;
  if (from) context.progress.note(fmt::format("heat: going on from {:.6g} s", *from));
  thermal::HeatRun run(outcome.model, scene.heat->time, std::move(state));
  const auto recorder = begin_recording(context, begin, outcome, from);
  if (!from) recorder->record(run.state());
  march(context, run, *recorder);
  outcome.state = run.state();
  outcome.solver = run.solver();
}

// One frame, at t = 0.
template <int dim>
void find_steady(RunContext& context, const std::function<void()>& begin, HeatOutcome<dim>& outcome) {
  auto steady = thermal::find_steady_state(*outcome.model, context.scene.heat->time.solver);
  const auto recorder = begin_recording(context, begin, outcome, std::nullopt);
  outcome.state = std::move(steady.state);
  outcome.solver = std::move(steady.solver);
  recorder->record(outcome.state);
  recorder->finish(context.last_files);
}

// How many blocks have one temperature each, if any.
std::optional<std::string> lumped_words(const thermal::HeatModel& model) {
  if (!model.lumped) return std::nullopt;
  const auto range = thermal::biot_range(*model.lumped);
  return fmt::format("{} of {} blocks are lumped, Biot numbers {:.2g} to {:.2g}; {} temperatures for {} nodes",
                     model.lumped->all().size(), model.bodies.size(), range.least, range.largest, model.capacity.size(),
                     model.rows.nodes());
}

// What the equations are of, where that is not simply every node.
template <int dim>
void say_rows(RunContext& context, const HeatOutcome<dim>& outcome) {
  if (const auto said = lumped_words(*outcome.model)) context.progress.note("heat: " + *said);
  if (const std::size_t tied = outcome.model->tied_nodes; tied > 0) {
    context.progress.note(
        fmt::format("heat: faces of perfect joints match: {} of {} nodes are one with others, {} temperatures", tied,
                    outcome.pile.mesh.nodes.size(), outcome.model->capacity.size()));
  }
}

// How much of the blocks' surfaces lies on others, and which boundaries act there, too.
template <int dim>
void find_overlaps(RunContext& context, HeatOutcome<dim>& outcome) {
  if (const auto& contacts = outcome.pile.contacts; !contacts.contacts.empty()) {
    outcome.overlap_areas = context.stage("areas", fmt::format("{} contacts", contacts.contacts.size()), [&] {
      return contact::overlap_areas(outcome.pile.mesh, contacts, search_of(context.scene, outcome.pile));
    });
  }
  outcome.covered = covered_boundaries(outcome.pile.mesh, context.scene.heat->boundaries, outcome.overlap_areas);
  for (const CoveredBoundary& boundary : outcome.covered) {
    context.remark(
        fmt::format("heat: {} acts on {:.4g} m2, of which {:.4g} m2 lie on other blocks; a box (`within`) can "
                    "leave them out",
                    boundary.name, boundary.area, boundary.covered_area));
  }
}

// Those beside the time error.
template <int dim>
void find_errors(RunContext& context, HeatOutcome<dim>& outcome) {
  const thermal::HeatState& state = outcome.state;
  if (outcome.model->lumped) {
    context.progress.note(
        fmt::format("heat: lumping blocks makes an error of some {:.2g} K (estimated)", state.lumping.largest));
  }
  const auto& probes = outcome.pile.probes;
  if (std::any_of(probes.begin(), probes.end(), [](const output::Probe<dim>& probe) { return probe.exact.has_value(); })) {
    outcome.exact_error = output::largest_error(output::read_probe_history(context.files.probes()));
  }
  if (context.estimate_space_error) {
    const thermal::NodeMap& rows = outcome.model->rows;
    const auto rate = thermal::temperature_rate(*outcome.model, state.temperature, state.time);
    outcome.space_error = thermal::estimate_space_error(outcome.pile.mesh, context.scene.materials,
                                                        rows.to_nodes(state.temperature), rows.to_nodes(rate));
  }
}

}  // namespace

template <int dim>
HeatOutcome<dim> heat_stage(RunContext& context, packing::Packing<dim> packing) {
  const Scene& scene = context.scene;
  const ThreadsInScope threads(threads_for(packing.mesh.nodes.size()));
  HeatOutcome<dim> outcome;
  outcome.pile = find_pile(context, packing);
  outcome.model = context.stage("assemble", fmt::format("{} contacts", outcome.pile.contacts.contacts.size()),
                                [&] { return heat_model(scene, outcome.pile); });
  if (const auto window = effective_window<dim>(scene)) {
    for (const std::string& sentence : window_beyond_blocks(outcome.pile.mesh, *scene.effective_window))
      context.remark(sentence);
    outcome.effective = context.stage("homogenise", fmt::format("{} steady states", 3 * dim), [&] {
      return thermal::effective_conductivity(outcome.pile.mesh, scene.materials,
                                             *undriven_model(scene, outcome.pile, outcome.model), *window);
    });
  }
  say_rows(context, outcome);
  const auto begin = [&] {
    check_interrupt();
    if (context.begun && !is_placed(scene)) return;  // when the blocks fell
    context.aside("begin", [&] {
      begin_results(context);
      keep_placed(context, packing);
      packing = {};
    });
  };
  context.stage("heat", fmt::format("{} nodes", outcome.pile.mesh.nodes.size()), [&] {
    scene.heat->time.steady ? find_steady(context, begin, outcome) : run_in_time(context, begin, outcome);
    return true;
  });
  find_errors(context, outcome);
  find_overlaps(context, outcome);
  return outcome;
}

template HeatOutcome<2> heat_stage<2>(RunContext&, packing::Packing<2>);
template HeatOutcome<3> heat_stage<3>(RunContext&, packing::Packing<3>);

}  // namespace scree::run
