#include "engine/rigid/sleepers.h"

namespace scree::rigid {

void Sleepers::put_to_sleep(const std::vector<int>& group) {
  for (const int block : group) groups_[block] = next_group_;
  sleeping_ += group.size();
  ++next_group_;
}

void Sleepers::wake(int block) {
  const int its_group = groups_[block];
  for (int& group : groups_) {
    if (group != its_group) continue;
    group = awake;
    --sleeping_;
  }
}

}  // namespace scree::rigid
