// From a frozen packing to temperatures in time: contacts, the heat balance, the time loop and its files.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "thermal/effective_conductivity.h"
#include "thermal/heat_run.h"
#include "thermal/space_error.h"
#include "tools/run/covered.h"
#include "tools/run/heat_recorder.h"
#include "tools/run/run_context.h"

namespace scree::run {

template <int dim>
struct HeatOutcome {
  HeatedPile<dim> pile;
  std::shared_ptr<const thermal::HeatModel> model;
  thermal::HeatState state;  // at the end
  // Where two bodies' blocks lie on each other, if any contact was found [m2].
  std::map<std::pair<BodyId, BodyId>, double> overlap_areas;
  std::vector<CoveredBoundary> covered;
  std::string solver;
  std::optional<double> exact_error;  // largest of all probes whose exact temperature the scene names, after the start [K]
  std::optional<thermal::SpaceError> space_error;                // at the end, if the user asks for it
  std::optional<thermal::EffectiveConductivity<dim>> effective;  // if the scene asks for it
};

// Takes the packing: its mesh goes on as the placed one, and a large mesh need not be held twice.
template <int dim>
HeatOutcome<dim> heat_stage(RunContext& context, packing::Packing<dim> packing);

}  // namespace scree::run
