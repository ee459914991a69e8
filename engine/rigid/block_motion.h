// Where a block is as a step begins and how it moves, as the looks at its pairs need it: three lines of memory. Bullet has it
// in a proxy, a body and a shape, and a look at a pair would wait for each of them.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

struct alignas(64) BlockMotion {
  btTransform pose;
  btVector3 velocity{0, 0, 0};             // of the centre [m/s]
  double spin = 0;                         // magnitude of the angular velocity [1/s]
  double radius = 0;                       // of the smallest sphere about the centre that holds the block [m]
  const PolyhedronShape* piece = nullptr;  // null: the block is of several
  const btRigidBody* body = nullptr;
};

BlockMotion motion_of(const btRigidBody& body);

// One of the two blocks of a pair, or of their pieces.
struct Side {
  const BlockMotion* block;
  const PolyhedronShape* piece;  // null: all of them
  double radius;                 // about the block's centre [m]
};

inline Side whole(const BlockMotion& block) {
  return {&block, block.piece, block.radius};
}

// No two points approach each other faster than this [m/s].
double fastest_approach(const Side& first, const Side& second);

}  // namespace scree::rigid
