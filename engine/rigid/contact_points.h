// Where two convex pieces touch: up to four points that carry the contact.
#pragma once

#include <array>
#include <vector>

#include "engine/packing/separation.h"

namespace scree::rigid {

struct ContactPoint {
  Eigen::Vector3d on_first;   // [m]
  Eigen::Vector3d on_second;  // [m]
  double distance = 0;        // along the normal, negative if they overlap [m]
};

struct ContactPoints {
  std::array<ContactPoint, 4> points;
  int count = 0;
};

// The overlap of a face with the face turned most against it, clipped to that face's prism, or the nearest points of two edges;
// points further apart than `range` [m] are left out. Of more than four, those that span the patch best are kept. Pieces closer
// than `clearance` [m], at which they touch, have one at least. But faces that are over each other by less than `rim` [m], and
// no deeper in each other than that, have none: of two blocks that lie flush beside each other, the side of one is no obstacle
// to what slides over the other.
struct ContactReach {
  double range = 0;
  double clearance = 0;
  double rim = 0;
};
ContactPoints contact_points(const packing::PlacedPiece& first, const packing::PlacedPiece& second,
                             const packing::Separation& separation, const ContactReach& reach);

}  // namespace scree::rigid
