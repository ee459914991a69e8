// Which blocks have one temperature each, and what that leaves out.
#pragma once

#include <optional>

#include "thermal/heat_model.h"

namespace scree::thermal {

// Of a model that has its boundaries, with a row per node of the mesh; nothing if no block is lumped.
//
// The Biot number of a block is Bi = sum(g_p R_p) + max(g_p c_p): g_p [W/K] the conductances of its patches (all contacts with
// one other block, or one exchange with surroundings, as it is at the start), R_p their bulk resistances and c_p their
// constrictions (inner_resistance.h), at the reference temperature of joints. Of a sphere in convection it is 0.9, of a slab
// convecting on both sides a third of h (V/A)/k (Incropera and DeWitt, Fundamentals of Heat and Mass Transfer, eq. 5.10), which
// knows nothing of where heat enters.
//
// Throws InputError, all problems in one, where the scene asks for a lumped block that is held in part, at a temperature that
// depends on place, or tied to another without resistance; an automatic choice meshes such a block.
template <int dim>
std::optional<LumpedBlocks> choose_lumped(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                          const contact::ContactSet<dim>& contacts, const JointConduction& joints,
                                          const HeatOptions& options, const HeatModel& model);

}  // namespace scree::thermal
