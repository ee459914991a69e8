// The run's evidence as JSON: summary.json (tools/README.md lists its keys; SI units throughout).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/base/stage_clock.h"
#include "tools/run/heat_stage.h"
#include "tools/run/packing_stage.h"

namespace scree::run {

using Json = nlohmann::ordered_json;

// What a summary says before anything is known: that the run goes on, the program, the scene.
Json opening_summary(const RunContext& context);

std::string text_of(const Json& summary);  // as its file

void write_summary(const RunFiles& files, const Json& summary);

template <int dim>
void add_packing(Json& summary, const PackingOutcome<dim>& outcome);

template <int dim>
void add_heat(Json& summary, const Scene& scene, const HeatOutcome<dim>& outcome);

void add_stages(Json& summary, const std::vector<StageCost>& costs);

// Why a finished run is not sound; empty if it is. Each entry names the figure and what to change.
template <int dim>
std::vector<std::string> unsound(const Scene& scene, const packing::Packing<dim>& packing);
template <int dim>
std::vector<std::string> unsound(const Scene& scene, const HeatOutcome<dim>& heat);

// What rounding hides of the energy ledger of a sound run, if that is more than its limit.
template <int dim>
std::optional<std::string> hidden_by_rounding(const Scene& scene, const HeatOutcome<dim>& heat);

}  // namespace scree::run
