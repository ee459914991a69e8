// What the heat part of a scene asks of its blocks, before any work is done.
#pragma once

#include "engine/mesh/block_mesh.h"
#include "engine/packing/packing.h"
#include "tools/scene/scene.h"

namespace scree::run {

// Throws InputError for what the scene's heat would be refused with: surfaces and regions that are not there, temperatures
// that are none, probes in voids. `blocks` lie where they are heated; in a scene that settles, where they start from, and what
// depends on where free bodies will lie is not asked.
template <int dim>
void check_heat(const Scene& scene, const mesh::BlockMesh<dim>& blocks);

// The same where all lie where they are heated, and for what the run would be refused with before its first step: joints,
// lumped blocks, steps. Takes the contacts' search and the assembly of the heat's model.
template <int dim>
void check_placed(const Scene& scene, const packing::Packing<dim>& packing);

}  // namespace scree::run
