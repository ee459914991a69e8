// Where a block is as a step begins and how it moves, as the looks at its pairs need it: three lines of memory. Bullet has it
// in a proxy, a body and a shape, and a look at a pair would wait for each of them. A block is in some twenty pairs, and is
// placed once for those that need it.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "engine/packing/separation.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

struct alignas(64) BlockMotion {
  btTransform pose;
  btVector3 velocity{0, 0, 0};                   // of the centre [m/s]
  double spin = 0;                               // magnitude of the angular velocity [1/s]
  double radius = 0;                             // of the smallest sphere about the centre that holds the block [m]
  const packing::PlacedPiece* placed = nullptr;  // null: the block is of several pieces
  const btRigidBody* body = nullptr;
};

// `placed` is where a block of one piece is to be placed before any two points of it and another are looked for.
BlockMotion motion_of(const btRigidBody& body, const packing::PlacedPiece& placed);
// Of one piece.
void place(const BlockMotion& block, packing::PlacedPiece& placed);

// One of the two blocks of a pair, or of their pieces.
struct Side {
  const BlockMotion* block;
  double radius;                 // about the block's centre [m]
  const PolyhedronShape* piece;  // null: the whole block

  [[nodiscard]] const mesh::ConvexPiece& shape() const { return piece == nullptr ? *block->placed->piece : piece->piece(); }
  [[nodiscard]] const PolyhedronShape& polyhedron() const {
    return piece == nullptr ? static_cast<const PolyhedronShape&>(*block->body->getCollisionShape()) : *piece;
  }
};

inline Side whole(const BlockMotion& block) {
  return {&block, block.radius, nullptr};
}

// `memory` is for a piece of several.
const packing::PlacedPiece& placed(const Side& side, packing::PlacedPiece& memory);

// The same where it is after `time` [s], if nothing meets it before.
const packing::PlacedPiece& placed_after(const Side& side, double time, packing::PlacedPiece& memory);

// No two points approach each other faster than this [m/s].
double fastest_approach(const Side& first, const Side& second);

}  // namespace scree::rigid
