// Which blocks are so near the place where they last were looked for that what was found about them from afar still holds.
#pragma once

#include <cstddef>
#include <vector>

#include <LinearMath/btTransform.h>

class btRigidBody;

namespace scree::rigid {

// No point within the radius about the origin is further from where it was than this [m].
double way_moved(const btTransform& from, const btTransform& to, double radius);

class Homes {
 public:
  // Blocks are at home until they are looked for: fixed ones for ever. No point of one at home is further than `range` [m] from
  // where it was when the block last was not at home, or goes further than that in a step.
  Homes(std::size_t blocks, double range);

  // Before a step, at the pose and speed in which the body enters it; its user index is its block, no point of which is further
  // than `radius` [m] from its centre. Several may be looked for at once.
  void look(const btRigidBody& body, double radius, double time_step);

  [[nodiscard]] bool at_home(int block) const { return at_home_[block] != 0; }

 private:
  double range_;
  std::vector<char> at_home_;
  std::vector<btTransform> homes_;
};

}  // namespace scree::rigid
