#include "tools/run/heat_recorder.h"

#include "thermal/space_error.h"
#include "tools/run/frames.h"

namespace scree::run {

namespace {

template <int dim>
output::ProbeTable start_table(const RunFiles& files, const HeatedPile<dim>& pile) {
  return output::ProbeTable(files.probes(), output::describe(pile.probes, pile.mesh), output::columns(pile.probes));
}

}  // namespace

template <int dim>
HeatRecorder<dim>::HeatRecorder(const Scene& scene, const RunFiles& files, const HeatedPile<dim>& pile,
                                std::optional<double> resumed_from)
    : scene_(scene),
      pile_(pile),
      restart_(files.restart()),
      grid_(output::make_grid(pile.mesh)),
      contact_grid_(contact_grid(pile.contacts)),
      identity_(identity_arrays(pile.mesh)),
      series_(files.directory, "heat", resumed_from),
      contact_series_(files.directory, "contacts", resumed_from) {
  if (pile.probes.empty()) return;
  if (resumed_from) {
    table_.emplace(files.probes(), *resumed_from);
  } else {
    table_.emplace(start_table(files, pile));
  }
}

template <int dim>
void HeatRecorder<dim>::record(const thermal::HeatState& state) {
  const auto flux = thermal::cell_fluxes(pile_.mesh, scene_.materials, state.temperature);
  output::Frame frame = heat_frame<dim>(state.time, identity_, state.temperature, flux);
  if (model_ != nullptr) {
    const auto rate = thermal::temperature_rate(*model_, state.temperature, state.time);
    const auto error = thermal::estimate_space_error(pile_.mesh, scene_.materials, state.temperature, rate);
    frame.cells.push_back({"space_error", 1, largest_in_cells(pile_.mesh, error.of_element)});
  }
  series_.write(grid_, frame);
  const auto form = scene_.heat->joint.form;
  auto flows = thermal::contact_flows(pile_.contacts, pile_.joints, state.temperature, form);
  contact_series_.write(contact_grid_, contact_frame(state.time, pile_.contacts, std::move(flows)));
  if (table_) table_->append(state.time, output::column_values(pile_.probes, pile_.mesh, state.temperature, state.time));
  thermal::write(state, pile_.key, restart_);
}

template class HeatRecorder<2>;
template class HeatRecorder<3>;

}  // namespace scree::run
