// The part of a fall in which nothing can touch anything yet, in closed form.
#pragma once

#include <functional>

#include "engine/rigid/world.h"

namespace scree::rigid {

// Moves the free blocks, at whole steps, to the last one at which their common bounding box is still clear of that of every
// fixed piece, and returns how many steps that took; none if the blocks do not all start with the same velocity or nothing is
// fixed. The blocks keep their places to each other, so nothing is left out: the neighbours of a mesh touch, and colliding them
// all the way down would cost more than the rest of the settling. `after_step(n)` is called after each.
//   v' = (1 - alpha) g - c v, from Cundall's local damping alpha and viscous damping c (damping.h)
std::int64_t skip_free_fall(World& world, const mesh::BlockMesh<3>& mesh, const SettleOptions& options,
                            const std::function<void(std::int64_t)>& after_step);

}  // namespace scree::rigid
