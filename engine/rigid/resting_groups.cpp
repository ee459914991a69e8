#include "engine/rigid/resting_groups.h"

#include <algorithm>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "engine/base/phases.h"
#include "engine/rigid/homes.h"
#include "engine/rigid/rest_window.h"

namespace scree::rigid {

namespace {

// Of what a pile at rest may have.
constexpr double part = 0.1;

// Part of the blocks that must come to sleep for any to do so: stones that rolled away from a heap cost next to nothing awake.
constexpr double worth_sleeping = 0.05;

}  // namespace

RestingGroups::RestingGroups(const World& world, const SettleOptions& options, double mean_edge, double time)
    : speed_(part * options.rest_speed),
      force_over_weight_(part * options.rest_unbalanced_force),
      allowed_(part * options.rest_displacement, mean_edge),
      window_(rest_window(options, mean_edge)),
      gravity_(options.gravity.norm()),
      records_(world.block_count()) {
  begin(world, time);
}

void RestingGroups::begin(const World& world, double time) {
  since_ = time;
  steps_ = 0;
  for (std::size_t i = 0; i < world.free_blocks().size(); ++i) {
    records_[world.free_blocks()[i]] = {.from = world.free_bodies()[i]->getWorldTransform()};
  }
}

void RestingGroups::observe(World& world, const Damping& damping, double time) {
  ++steps_;
  for_short_chunks(world.free_blocks().size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const BlockId block = world.free_blocks()[i];
      Record& record = records_[block];
      if (world.asleep(block) || !record.from) continue;
      ++record.steps;
      const btRigidBody& body = *world.free_bodies()[i];
      record.energy = std::max(record.energy, kinetic_energy(body, world.mass(block)));
      record.way = std::max(record.way, way_moved(*record.from, body.getWorldTransform(), world.radius(block)));
      record.force = std::max(record.force, damping.net_force(world, block));
    }
  });
  if (!is_over(time - since_, window_)) return;
  std::vector<std::vector<BlockId>> resting = world.touching_groups();
  std::erase_if(resting, [&](const auto& group) { return !at_rest(world, group); });
  std::size_t blocks = world.sleeping();
  for (const auto& group : resting) blocks += group.size();
  if (static_cast<double>(blocks) >= worth_sleeping * static_cast<double>(world.free_blocks().size())) {
    for (const auto& group : resting) world.put_to_sleep(group);
  }
  begin(world, time);
}

bool RestingGroups::at_rest(const World& world, const std::vector<BlockId>& group) const {
  double energy = 0, force = 0, mass = 0;
  for (const BlockId block : group) {
    const Record& record = records_[block];
    if (record.steps < steps_ || record.way > allowed_(world, block)) return false;
    energy += record.energy;
    force += record.force;
    mass += world.mass(block);
  }
  return 2 * energy < mass * speed_ * speed_ && force < force_over_weight_ * mass * gravity_;
}

}  // namespace scree::rigid
