// Whether an edge of one shell and an edge of another may touch: bounds in single precision that touch.h decides.
#pragma once

#include <vector>

#include "contact/edge_pairs.h"
#include "contact/shell.h"
#include "contact/tetrahedron.h"

namespace scree::contact {

inline constexpr float flat_sine_bound = 0.018F;  // a little more than an edge may be risen above in touch_edge

// Two shells, and pairs of their edges.
struct ShellEdges {
  const Shell<3>* first = nullptr;
  const Shell<3>* second = nullptr;
  EdgePairs edges = 0;
};

// Pairs of edges of which the semi-edge in the k-th face `beside` the edge of the first may touch the edge of the second; and
// of which the semi-edge beside the edge of the second may touch that of the first, likewise.
struct TouchingEdges {
  std::array<EdgePairs, 2> of_first{};
  std::array<EdgePairs, 2> of_second{};
};

// Those of many times two shells, which are worked on together as there are few edges of each (touching_edges.cpp).
void find_touching_edges(const std::vector<ShellEdges>& shells, double indentation, std::vector<TouchingEdges>& touching);

// Along the common normal of two edges of blocks of one tetrahedron: do both stand out, and does the owner's face beside its
// edge look against it? What rounding leaves open passes.
bool may_face(const Shell<3>& owner, const ElementEdge& edge, int beside, const Shell<3>& other, const ElementEdge& target);

}  // namespace scree::contact
