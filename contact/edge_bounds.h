// Whether an edge of one shell and an edge of another may touch: bounds in single precision that touch.h decides.
#pragma once

#include "contact/edge_pairs.h"
#include "contact/near_shells.h"
#include "contact/tetrahedron.h"

namespace scree::contact {

// Which edges of two shells come so near, and lie so, that they may touch.
EdgePairs near_edges(const ShellPair<3>& pair);

// An edge of the one shell and one of the other, as numbers of element_edges.
struct EdgePair {
  int of_first = 0;
  int of_second = 0;
};

// The semi-edges beside the edges of two shells, four pairs of edges at a time. Lengths are in radii of the first, so that
// their products keep within the range of single precision.
class EdgeBounds {
 public:
  using Pairs = std::array<EdgePair, lane_count>;

  EdgeBounds(const Shell<3>& first, const Shell<3>& second, double indentation)
      : EdgeBounds(first, second, Way<3>(first, second), 1 / first.radius, static_cast<float>(indentation)) {}

  // Of four pairs, one bit each, those of which the semi-edge in the k-th face `beside` the edge of the first may touch the
  // edge of the second; and those of which the semi-edge beside the edge of the second may touch that of the first, likewise.
  struct Touching {
    std::array<unsigned, 2> of_first{};
    std::array<unsigned, 2> of_second{};
  };
  [[nodiscard]] Touching may_touch(const Pairs& pairs) const;

 private:
  // A row for each vertex of a shell, seen from the centre of the first, and one for the way from each vertex but the last to
  // each other: the three axes. No edge starts at the last.
  struct Rows {
    explicit Rows(const LanePoints<3>& vertices);

    std::array<Lanes, 4> at;
    std::array<std::array<Lanes, 4>, 3> ways;
  };

  // Where the lines of four pairs of edges come closest.
  struct Crossing {
    Lanes square;                // of the common normal, the cross product of the edges
    Lanes along_first;           // fraction of the way along the edge of the first, times that square
    Lanes along_second;          // the same on the edge of the second
    LanePoints<3> across_first;  // from the edge of the first sideways, in the plane of both
    LanePoints<3> across_second;
    Lanes off_first, off_second;  // of along_first and along_second, by rounding
    unsigned near = 0;            // bit i: the pair i may touch, as far as this tells
  };
  EdgeBounds(const Shell<3>& first, const Shell<3>& second, const Way<3>& way, float unit, float indentation);
  [[nodiscard]] Crossing crossing(const Pairs& pairs) const;

  Rows first_, second_;
  float distance_;  // between the lines of edges that touch, at most
  float off_;       // of a length, by rounding
  float kept_;      // length of a semi-edge, over that of its edge
  float moved_;     // share of each corner of its face in a semi-spring
  float aside_;     // the third corner of a face moves its semi-edges by no more
};

// Along the common normal of two edges of blocks of one tetrahedron: do both stand out, and does the owner's face beside its
// edge look against it? What rounding leaves open passes.
bool may_face(const Shell<3>& owner, const ElementEdge& edge, int beside, const Shell<3>& other, const ElementEdge& target);

}  // namespace scree::contact
