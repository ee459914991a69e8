// Which blocks fall: those that have touched nothing since they were let go, or have come further than their own width since
// they last did. At the top of its flight a block stands still and falls all the same.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/rigid/damping.h"

namespace scree::rigid {

class FallingBlocks {
 public:
  FallingBlocks(const World& world, Eigen::Vector3d gravity) : gravity_(std::move(gravity)), held_at_(world.block_count()) {}

  // After every step: blocks of which anything else than gravity changes the momentum touch something.
  void observe(const World& world, const Damping& damping);
  // One of them, if any falls.
  [[nodiscard]] std::optional<BlockId> any(const World& world) const;

 private:
  Eigen::Vector3d gravity_;                              // [m/s2]
  std::vector<std::optional<Eigen::Vector3d>> held_at_;  // where a block's centre was as it last touched anything, by block [m]
};

}  // namespace scree::rigid
