// Which blocks of a packing touch, and with what: faces, edges or points.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/packing/near_pieces.h"

namespace scree::packing {

// Those first that leave the blocks the least freedom.
enum class Meeting : std::uint8_t { face_face, face_edge, face_point, edge_edge, edge_point, point_point };

struct TouchingPair {
  BlockId first, second;  // ascending
  Meeting meeting = Meeting::face_point;
  double gap = 0;  // negative where they overlap [m]
};

struct TouchOptions {
  double range = 0;  // blocks nearer than this touch [m]
  double lean = 0;   // two features lie on each other if they lean from each other by no more than this [rad]
};

// Every pair of blocks that touch, of which one at least is free, ordered. Blocks in several convex pieces meet as those of
// their pieces do that leave them the least freedom, for others touch by the seams between them only.
//
// A pair touches across the plane that parts it best (separation.h). Each side takes part with the face that leans from that
// plane by less than `lean`, or else with such an edge, or else with its foremost vertex. Faces and edges that lie in the same
// plane but overlap by less than `range` in it meet at their rims: edge_edge.
std::vector<TouchingPair> touching_pairs(const PieceSet& pieces, const TouchOptions& options);

}  // namespace scree::packing
