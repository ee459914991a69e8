// What the heat part of a scene asks of its blocks, before any work is done.
#pragma once

#include "engine/mesh/block_mesh.h"
#include "tools/scene/scene.h"

namespace scree::run {

// Throws InputError for what the scene's heat would be refused with: surfaces and regions that are not there, temperatures
// that are none, probes in voids. `blocks` lie where they are heated; in a scene that settles, where they start from, and what
// depends on where free bodies will lie is not asked.
template <int dim>
void check_heat(const Scene& scene, const mesh::BlockMesh<dim>& blocks);

}  // namespace scree::run
