#include "engine/rigid/block_motion.h"

namespace scree::rigid {

BlockMotion motion_of(const btRigidBody& body) {
  const btCollisionShape& shape = *body.getCollisionShape();
  const auto* piece = shape.isCompound() ? nullptr : static_cast<const PolyhedronShape*>(&shape);
  return {
      body.getWorldTransform(), body.getLinearVelocity(), body.getAngularVelocity().length(), radius_of(shape), piece, &body};
}

double fastest_approach(const Side& first, const Side& second) {
  return (first.block->velocity - second.block->velocity).length() + first.radius * first.block->spin +
         second.radius * second.block->spin;
}

}  // namespace scree::rigid
