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

struct ContactReach {
  double range = 0;      // points further apart are left out [m]
  double clearance = 0;  // at which two pieces touch [m]
  double rim = 0;        // faces over each other by less have only their rims in common [m]
};

// The overlap of a face with the face turned most against it, clipped to that face's prism, or the nearest points of two edges;
// of more than four, those that span the patch best are kept. Pieces closer than the clearance have one at least. But faces
// that are over each other by less than the rim, and no deeper in each other than that, have none: of two blocks that lie flush
// beside each other, the side of one is no obstacle to what slides over the other.
ContactPoints contact_points(const packing::PlacedPiece& first, const packing::PlacedPiece& second,
                             const packing::Separation& separation, const ContactReach& reach);

}  // namespace scree::rigid
