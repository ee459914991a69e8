// Whether an edge of one shell and an edge of another may touch: bounds in single precision that touch.h decides.
#pragma once

#include "contact/edge_pairs.h"
#include "contact/near_shells.h"
#include "contact/tetrahedron.h"

namespace scree::contact {

// Which edges of two shells come so near, and lie so, that they may touch.
EdgePairs near_edges(const ShellPair<3>& pair);

// The semi-edges beside the edges of two shells, four edges of the first at a time. Lengths are in radii of the first, so that
// their products keep within the range of single precision.
class EdgeBounds {
 public:
  EdgeBounds(const Shell<3>& first, const Shell<3>& second, double indentation);

  // Of edges of the first, one bit each, those with a semi-edge that may touch an edge of the second: of the semi-edges in the
  // faces `beside` the own edge; and those that a semi-edge of the second beside that edge may touch, likewise.
  struct Touching {
    std::array<unsigned, 2> of_first{};
    std::array<unsigned, 2> of_second{};
  };
  [[nodiscard]] Touching may_touch(unsigned some, const ElementEdge& of_second) const;

 private:
  // Four edges.
  struct Group {
    LanePoints<3> starts;
    LanePoints<3> ways;
    std::array<LanePoints<3>, 2> shifts;  // from the start of an edge to those of its semi-edges
    Lanes squares;                        // of the edges' lengths
    Lanes lengths;
  };
  struct Edge {
    std::array<float, 3> start;
    std::array<float, 3> way;
    std::array<std::array<float, 3>, 2> shifts;
    float square;
    float length;
  };
  [[nodiscard]] Edge edge_of_second(const ElementEdge& edge) const;
  void add(const Group& group, unsigned first_bit, unsigned some, const Edge& edge, Touching& touching) const;

  std::array<Group, 2> groups_;
  LanePoints<3> second_;  // vertices from the first's centre
  float distance_;        // between the lines of edges that touch, at most
  float off_;             // of a length, by rounding
  float kept_;            // length of a semi-edge, over that of its edge
  float moved_;           // share of each corner of its face in a semi-spring
};

// Along the common normal of two edges of blocks of one tetrahedron: do both stand out, and does the owner's face beside its
// edge look against it? What rounding leaves open passes.
bool may_face(const Shell<3>& owner, const ElementEdge& edge, int beside, const Shell<3>& other, const ElementEdge& target);

}  // namespace scree::contact
