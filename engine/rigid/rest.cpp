#include "engine/rigid/rest.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/rigid/homes.h"
#include "engine/rigid/rest_window.h"

namespace scree::rigid {

double kinetic_energy(const btRigidBody& body, double mass) {
  const btVector3 spin = body.getWorldTransform().getBasis().transpose() * body.getAngularVelocity();
  const btVector3 inverse = body.getInvInertiaDiagLocal();
  double energy = mass * body.getLinearVelocity().length2() / 2;
  for (int i = 0; i < 3; ++i) energy += spin[i] * spin[i] / inverse[i] / 2;
  return energy;
}

double AllowedWay::operator()(const World& world, BlockId block) const {
  return part_ * std::min(mean_edge_, 2 * world.radius(block));
}

Motion observe_motion(const World& world, const Damping& damping, double time_step) {
  Motion motion;
  double energy = 0;
  double total = 0;
  for (std::size_t i = 0; i < world.free_blocks().size(); ++i) {
    const btRigidBody& body = *world.free_bodies()[i];
    const BlockId block = world.free_blocks()[i];
    total += world.mass(block);
    if (world.asleep(block)) continue;
    energy += kinetic_energy(body, world.mass(block));
    motion.max_speed = std::max(motion.max_speed,
                                body.getLinearVelocity().length() + world.radius(block) * body.getAngularVelocity().length());
  }
  if (total > 0) motion.rms_speed = std::sqrt(2 * energy / total);
  const double contact = world.mean_contact_force(time_step);
  const double net = damping.mean_net_force(world);
  // Without any contact nothing bears the blocks: all of the force is unbalanced.
  motion.unbalanced = contact > 0 ? net / contact : (net > 0 || motion.max_speed > 0 ? 1.0 : 0.0);
  return motion;
}

RestWatch::RestWatch(const World& world, const SettleOptions& options, double mean_edge, double time)
    : rest_speed_(options.rest_speed),
      rest_unbalanced_(options.rest_unbalanced_force),
      rest_window_(rest_window(options, mean_edge)),
      allowed_(options.rest_displacement, mean_edge) {
  begin(world, time);
}

void RestWatch::begin(const World& world, double time) {
  since_ = time;
  largest_ = {};
  blocks_ = world.free_blocks();
  poses_.clear();
  for (const btRigidBody* body : world.free_bodies()) poses_.push_back(body->getWorldTransform());
  way_ = 0;
  furthest_ = {};
}

bool RestWatch::quiet() const {
  return largest_.rms_speed < rest_speed_ && largest_.unbalanced < rest_unbalanced_;
}

void RestWatch::look_for_ways(const World& world) {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const double way = way_moved(poses_[i], world.free_bodies()[i]->getWorldTransform(), world.radius(blocks_[i]));
    way_ = std::max(way_, way);
    const double over_allowed = way / allowed_(world, blocks_[i]);
    if (over_allowed > furthest_.over_allowed) furthest_ = {blocks_[i], way, over_allowed};
  }
}

bool RestWatch::observe(const World& world, const Motion& motion, double time) {
  largest_.rms_speed = std::max(largest_.rms_speed, motion.rms_speed);
  largest_.unbalanced = std::max(largest_.unbalanced, motion.unbalanced);
  const bool over = is_over(time - since_, rest_window_);
  const bool same_blocks = blocks_ == world.free_blocks();
  // What is back where it was at the end, as a stone that bounces may be, has moved. Of no interest while others move.
  if (same_blocks && (over || quiet())) look_for_ways(world);
  if (!over) return false;
  window_ = time - since_;
  displacement_ = way_;
  last_ = largest_;
  last_furthest_ = furthest_;
  lost_some_ = !same_blocks;
  const bool rest = quiet() && same_blocks && furthest_.over_allowed < 1;
  begin(world, time);
  return rest;
}

std::string RestWatch::criterion() const {
  return fmt::format(
      "in every step of a window of {:.3g} s the root mean square speed is below {:g} m/s and the unbalanced force (mean net "
      "force on a block over mean force of a touching pair) below {:g}, and no point of any block has moved more than {:.3g} m "
      "in it, nor more than {:g} of the block's width",
      rest_window_, rest_speed_, rest_unbalanced_, allowed_.largest(), allowed_.part());
}

std::string RestWatch::obstacle() const {
  if (window_ == 0) return "no whole window has passed";
  std::string text = fmt::format("in the last whole window the speed reached {:.3g} m/s, the unbalanced force {:.3g}",
                                 last_.rms_speed, last_.unbalanced);
  if (last_furthest_.way > 0) {
    text += fmt::format(", a point of block {} moved {:.3g} m", last_furthest_.block.value(), last_furthest_.way);
  }
  if (lost_some_) text += ", a block left the scene";
  return text;
}

}  // namespace scree::rigid
