// From a frozen packing to temperatures in time: contacts, the heat balance, the time loop and its files.
#pragma once

#include "thermal/heat_run.h"
#include "tools/run/heat_recorder.h"
#include "tools/run/run_context.h"

namespace scree::run {

template <int dim>
struct HeatOutcome {
  HeatedPile<dim> pile;
  thermal::HeatModel model;
  thermal::HeatState state;  // at the end
  std::string solver;
};

template <int dim>
HeatOutcome<dim> heat_stage(RunContext& context, const packing::Packing<dim>& packing);

}  // namespace scree::run
