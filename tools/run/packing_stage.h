// From bodies to a frozen packing: mesh, drop and settle, or take the packing that is already there.
#pragma once

#include "engine/packing/packing.h"
#include "tools/run/run_context.h"

namespace scree::run {

template <int dim>
struct PackingOutcome {
  packing::Packing<dim> packing;
  bool reused = false;  // from an earlier run whose settle stage had the same key
};

// The packing file the scene names, with the scene's bodies.
template <int dim>
packing::Packing<dim> stored_packing(const Scene& scene);

template <int dim>
PackingOutcome<dim> packing_stage(RunContext& context);

}  // namespace scree::run
