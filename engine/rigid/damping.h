// Forces that take energy out of the fall, and the net force they depend on.
#pragma once

#include <vector>

#include "engine/rigid/world.h"

namespace scree::rigid {

// Local damping (Cundall 1987; Itasca, PFC, "local damping"): on every component of a block's motion a force
//   F_d = -alpha |F| sign(v),
// F being the net force without damping. It vanishes with F, so it bears no part of the weight of a pile at rest, and it makes
// a block fall freely with (1 - alpha) g. PFC evaluates it on forces that vary slowly from step to step; here contacts are
// solved as impulses after it, so F is that of the last step (gravity and contacts, from the change of momentum), and the
// damping impulse |F_d| dt may stop a component but not turn it round. Rotation likewise, about the principal axes.
//
// Viscous damping: dv/dt = -c v, dw/dt = -c w, explicit in time, so that the final speed of a fall is g/c whatever the step.
class Damping {
 public:
  Damping(const World& world, const Eigen::Vector3d& gravity);

  // Slows the blocks that are awake before a step; `viscous` in 1/s.
  void slow_down(const World& world, double local, double viscous, double time_step);
  // Takes the net forces of the step just made.
  void observe(const World& world, double time_step);

  // Magnitude of the net force of the last step on every block, damping excluded; 0 on those that are not in the fall [N].
  [[nodiscard]] Table<BlockId, double> net_forces(const World& world) const;
  // Mean over the free blocks of the magnitude of the net force of the last step, damping excluded [N].
  [[nodiscard]] double mean_net_force(const World& world) const;
  // Of one of them, by its mass [m/s2].
  [[nodiscard]] const Eigen::Vector3d& acceleration(BlockId block) const { return motions_[block.index()].acceleration; }
  // Of one of them; of a sleeping one, that of the last step in which it was awake [N].
  [[nodiscard]] double net_force(const World& world, BlockId block) const;

 private:
  struct Motion {
    Eigen::Vector3d velocity;      // before the step [m/s]
    Eigen::Vector3d rotation;      // before the step, world axes [rad/s]
    Eigen::Vector3d acceleration;  // net force over mass [m/s2]
    Eigen::Vector3d angular;       // net torque over inertia, principal axes [rad/s2]
  };
  std::vector<Motion> motions_;  // by block index
};

}  // namespace scree::rigid
