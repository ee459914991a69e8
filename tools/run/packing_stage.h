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

// Whether blocks stay where the scene places them.
bool is_placed(const Scene& scene);

// The bodies of a packing must be those of the scene, since boundaries and materials speak of them: throws InputError, or gives
// them the scene's materials. Of a packing that knows what they were made from, they must be made alike.
template <int dim>
Table<BodyId, mesh::Body> adopted_bodies(const Scene& scene, const packing::Packing<dim>& packing);

// How many blocks are of bodies that move.
template <int dim>
std::size_t free_blocks(const mesh::BlockMesh<dim>& mesh);

// Throws InputError if blocks would come to rest too far apart for the scene, or not within the time that it gives them.
void check_fall(const Scene& scene, const mesh::BlockMesh<3>& blocks);

// The packing file the scene names, with the scene's bodies.
template <int dim>
packing::Packing<dim> stored_packing(const Scene& scene);

// Writes the packing of blocks that stay where they are placed; to be called when nothing of the scene can be refused any more.
template <int dim>
void keep_placed(const RunContext& context, const packing::Packing<dim>& packing);

template <int dim>
PackingOutcome<dim> packing_stage(RunContext& context);

}  // namespace scree::run
