// Where heat comes in: fixed temperatures, fluxes and flows on faces, sources in elements.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Fills in the loads, the fixed nodes and the names of `model`, whose vectors have their size already. Throws InputError, all
// problems in one, for a region that holds nothing and for a node that two boundaries hold at different temperatures.
template <int dim>
void apply_boundaries(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options, HeatModel& model);

}  // namespace scree::thermal
