// Where blocks touch. Geometry only: a contact knows no temperature.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::contact {

// What meets what: a semi-spring and its target face (2-D: target edge), a semi-edge and its target edge (3-D only), or two
// faces in a quadrature point of their overlap.
enum class Kind : std::uint8_t { point_face, edge_edge, overlap };

// A point of a block as a weighted mean of nodes on its surface; weights sum to 1. An edge uses two of the three
// entries in 3-D and gives the third weight 0.
template <int dim>
struct Stencil {
  std::array<NodeId, dim> nodes;
  std::array<double, dim> weights{};
};

template <int dim>
struct Contact {
  Kind kind = Kind::point_face;
  BlockId owner;           // of the semi-spring or semi-edge; of an overlap, the block of the lower face
  BlockId target;          // always another block than the owner
  Stencil<dim> on_owner;   // the contact point on the owner, by position
  Stencil<dim> on_target;  // the closest point on the target
  // Where the paper puts the owner's share of the flow: a semi-spring's vertex (12), a semi-edge's two vertices (13). An
  // overlap has no vertex, and this is on_owner.
  Stencil<dim> literal_owner;
  ElementId owner_element;  // gives the characteristic length of eq. (11)
  ElementId target_element;
  double area = 0;  // (9), (10), or the point's share of the overlap [m2] (2-D: times unit thickness)
  // Characteristic length of the owner's element. Of an overlap, which stands for the semi-springs of both sides:
  // 1/(1/dL1 + 1/dL2) [m].
  double length = 0;
  double gap = 0;    // signed distance from the target, negative inside it [m]
  Point<dim> point;  // where it is [m]
};

// Ordered by owner, owner's face, corner, and target, so that equal packings give equal sets; overlaps come after the others.
template <int dim>
struct ContactSet {
  std::vector<Contact<dim>> contacts;
  std::size_t semi_springs = 0;  // all there are, with a target or without
  std::size_t semi_edges = 0;

  [[nodiscard]] std::size_t count(Kind kind) const {
    std::size_t n = 0;
    for (const auto& contact : contacts) n += contact.kind == kind ? 1 : 0;
    return n;
  }
};

}  // namespace scree::contact
