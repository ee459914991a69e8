#include "engine/rigid/falling_blocks.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "engine/base/phases.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

constexpr double rounding = 1e-6;  // of gravity, in how far a flight follows it

Eigen::Vector3d centre(const World& world, std::size_t which) {
  return from_bullet(world.free_bodies()[which]->getCenterOfMassPosition());
}

}  // namespace

void FallingBlocks::observe(const World& world, const Damping& damping) {
  for_short_chunks(world.free_blocks().size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const BlockId block = world.free_blocks()[i];
      const bool flies = (damping.acceleration(block) - gravity_).norm() <= rounding * gravity_.norm();
      if (!flies) held_at_[block.index()] = centre(world, i);
    }
  });
}

std::optional<BlockId> FallingBlocks::any(const World& world) const {
  for (std::size_t i = 0; i < world.free_blocks().size(); ++i) {
    const BlockId block = world.free_blocks()[i];
    const auto& held = held_at_[block.index()];
    if (!held || (centre(world, i) - *held).norm() > 2 * world.radius(block)) return block;
  }
  return std::nullopt;
}

}  // namespace scree::rigid
