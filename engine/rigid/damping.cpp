#include "engine/rigid/damping.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

#include "engine/base/phases.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

Eigen::Matrix3d axes(const btRigidBody& body) {
  return from_bullet(body.getWorldTransform().getBasis());
}

// Each component comes nearer to zero by up to `change`.
Eigen::Vector3d reduced(Eigen::Vector3d value, const Eigen::Vector3d& change) {
  for (int i = 0; i < 3; ++i) value[i] -= std::copysign(std::min(std::abs(change[i]), std::abs(value[i])), value[i]);
  return value;
}

}  // namespace

Damping::Damping(const World& world, const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  motions_.assign(world.block_count(), {zero, zero, gravity, zero});
}

void Damping::slow_down(const World& world, double local, double viscous, double time_step) {
  const double kept = 1 - viscous * time_step;
  for_short_chunks(world.free_blocks().size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      Motion& motion = motions_[world.free_blocks()[i].index()];
      if (world.asleep(world.free_blocks()[i])) {
        motion.velocity = motion.rotation = Eigen::Vector3d::Zero();  // from which it wakes
        continue;
      }
      btRigidBody& body = *world.free_bodies()[i];
      motion.velocity = from_bullet(body.getLinearVelocity());
      motion.rotation = from_bullet(body.getAngularVelocity());
      if (local > 0) {
        const Eigen::Matrix3d to_world = axes(body);
        motion.velocity = reduced(motion.velocity, local * time_step * motion.acceleration);
        motion.rotation = to_world * reduced(to_world.transpose() * motion.rotation, local * time_step * motion.angular);
      }
      motion.velocity *= kept;
      motion.rotation *= kept;
      body.setLinearVelocity(to_bullet(motion.velocity));
      body.setAngularVelocity(to_bullet(motion.rotation));
    }
  });
}

void Damping::observe(const World& world, double time_step) {
  for_short_chunks(world.free_blocks().size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      if (world.asleep(world.free_blocks()[i])) continue;
      const btRigidBody& body = *world.free_bodies()[i];
      Motion& motion = motions_[world.free_blocks()[i].index()];
      motion.acceleration = (from_bullet(body.getLinearVelocity()) - motion.velocity) / time_step;
      motion.angular = axes(body).transpose() * (from_bullet(body.getAngularVelocity()) - motion.rotation) / time_step;
    }
  });
}

double Damping::net_force(const World& world, BlockId block) const {
  return world.mass(block) * motions_[block.index()].acceleration.norm();
}

Table<BlockId, double> Damping::net_forces(const World& world) const {
  Table<BlockId, double> forces(motions_.size());
  for (const BlockId block : world.free_blocks()) {
    forces[block] = net_force(world, block);
  }
  return forces;
}

double Damping::mean_net_force(const World& world) const {
  double sum = 0;
  for (const BlockId block : world.free_blocks()) sum += net_force(world, block);
  return world.free_blocks().empty() ? 0.0 : sum / static_cast<double>(world.free_blocks().size());
}

}  // namespace scree::rigid
