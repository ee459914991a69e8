// Which blocks do not move: fixed ones, and groups of touching blocks that came to rest while others still move
// (resting_groups.h). Nothing is worked out for a sleeping block, or for a pair of blocks that do not move, until something
// touches the group.
#pragma once

#include <cstddef>
#include <vector>

namespace scree::rigid {

class Sleepers {
 public:
  explicit Sleepers(std::size_t blocks) : groups_(blocks, awake) {}

  void fix(int block) { groups_[block] = fixed; }
  void put_to_sleep(const std::vector<int>& group);
  // Wakes all of the block's group.
  void wake(int block);

  [[nodiscard]] bool asleep(int block) const { return groups_[block] >= 0; }
  [[nodiscard]] bool still(int block) const { return groups_[block] != awake; }
  [[nodiscard]] std::size_t count() const { return sleeping_; }  // of the blocks asleep

 private:
  static constexpr int awake = -2;
  static constexpr int fixed = -1;

  std::vector<int> groups_;  // of each block
  int next_group_ = 0;
  std::size_t sleeping_ = 0;  // blocks
};

}  // namespace scree::rigid
