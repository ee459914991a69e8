#include "engine/rigid/block_motion.h"

#include <LinearMath/btTransformUtil.h>

namespace scree::rigid {

namespace {

void place(const PolyhedronShape& shape, const btTransform& pose, packing::PlacedPiece& placed) {
  packing::place(shape.piece(), from_bullet(pose.getBasis()), from_bullet(pose.getOrigin()), placed);
}

}  // namespace

BlockMotion motion_of(const btRigidBody& body, const packing::PlacedPiece& placed) {
  const btCollisionShape& shape = *body.getCollisionShape();
  BlockMotion motion{body.getWorldTransform(), body.getLinearVelocity()};
  motion.spin = body.getAngularVelocity().length();
  motion.radius = radius_of(shape);
  motion.body = &body;
  if (!shape.isCompound()) motion.placed = &placed;
  return motion;
}

void place(const BlockMotion& block, packing::PlacedPiece& placed) {
  place(whole(block).polyhedron(), block.pose, placed);
}

const packing::PlacedPiece& placed(const Side& side, packing::PlacedPiece& memory) {
  if (side.piece == nullptr) return *side.block->placed;
  place(*side.piece, side.block->pose, memory);
  return memory;
}

const packing::PlacedPiece& placed_after(const Side& side, double time, packing::PlacedPiece& memory) {
  const BlockMotion& block = *side.block;
  btTransform pose;
  btTransformUtil::integrateTransform(block.pose, block.velocity, block.body->getAngularVelocity(), time, pose);
  packing::place(side.shape(), from_bullet(pose.getBasis()), from_bullet(pose.getOrigin()), memory);
  return memory;
}

double fastest_approach(const Side& first, const Side& second) {
  return (first.block->velocity - second.block->velocity).length() + first.radius * first.block->spin +
         second.radius * second.block->spin;
}

}  // namespace scree::rigid
