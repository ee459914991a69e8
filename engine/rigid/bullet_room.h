// What needs Bullet, behind one door: all of it is in a library of its own (libscree_bullet.so) that the first call of settle()
// loads, so that what lets nothing fall does without it. Here is what the two sides know of each other; for this room only.
#pragma once

#include "engine/rigid/settle.h"

namespace scree::rigid::bullet {

// In the library: rigid::settle() itself.
packing::Packing<3> settle(const mesh::BlockMesh<3>& blocks, const Table<MaterialId, Material>& materials,
                           const SettleOptions& options, const FrameSink& frame, const SettleProgress& progress);

}  // namespace scree::rigid::bullet

// The door: what the library exports.
extern "C" decltype(&scree::rigid::bullet::settle) scree_bullet_settle();
