// Groups of touching blocks that come to rest by themselves, such as a heap beside one that still moves. They need not wait for
// the others; nothing more is worked out for them until something touches them (sleepers.h). Where few blocks would sleep, all
// stay awake.
//
// A group is at rest if in a window as long as that of the whole pile (rest.h) the kinetic energy of its blocks, each at its
// largest, is that of a tenth of the speed at which the pile may be at rest, their mean net force, each at its largest, a tenth
// of the unbalanced force that it may have, over the mean weight of a block, and no block was ever further than a tenth of
// what it may from where it began. So what is left of motion when a group falls asleep would not keep the pile from rest, and
// its contacts keep the impulses that bear it: it wakes up in balance.
#pragma once

#include <optional>
#include <vector>

#include <LinearMath/btTransform.h>

#include "engine/rigid/damping.h"
#include "engine/rigid/rest.h"

namespace scree::rigid {

class RestingGroups {
 public:
  RestingGroups(const World& world, const SettleOptions& options, double mean_edge, double time);

  // After each step that ends at `time` [s]: puts groups to sleep at the end of a window.
  void observe(World& world, const Damping& damping, double time);

 private:
  struct Record {
    int steps = 0;                    // awake
    double energy = 0;                // kinetic, the largest [J]
    double force = 0;                 // net, the largest [N]
    double way = 0;                   // from the beginning, the largest [m]
    std::optional<btTransform> from;  // at the beginning; nothing if it was let go since
  };
  void begin(const World& world, double time);
  [[nodiscard]] bool at_rest(const World& world, const std::vector<BlockId>& group) const;

  double speed_, force_over_weight_;
  AllowedWay allowed_;
  double window_, gravity_;
  double since_ = 0;
  int steps_ = 0;                   // of the window; 0 before the first one
  Table<BlockId, Record> records_;  // of the window
};

}  // namespace scree::rigid
