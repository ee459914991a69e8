// Where heat comes in: fixed temperatures, fluxes, flows, convection and radiation on faces, sources in elements.
//
// A face gives each of its corners the same share of its area, an element each corner of its volume; functions of place are
// taken at the nodes.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Fills in the holds, loads and exchanges of `model`, which has its places and sizes already. Throws InputError, all
// problems in one, for a region that holds nothing and for a node that two boundaries hold at different temperatures. Of
// bodies that still move, regions within a box are left out: what they will hold is not known.
template <int dim>
void apply_boundaries(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options, const MovingBodies& moving,
                      HeatModel& model);

// Nodes that a condition holds, or heats through a face: what perfect joints ask for. Empty if no joint is perfect; throws as
// apply_boundaries does.
template <int dim>
DrivenNodes driven_nodes(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options);

}  // namespace scree::thermal
