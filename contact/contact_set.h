// Where blocks touch. Geometry only: a contact knows no temperature.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/base/written_later.h"
#include "engine/mesh/block_mesh.h"

namespace scree::contact {

// What meets what: a semi-spring and its target face (2-D: target edge), a semi-edge and its target edge (3-D only), or two
// faces in a quadrature point of their overlap.
enum class Kind : std::uint8_t { point_face, edge_edge, overlap };

// In 2-D, where a face has two corners always.
struct NoFourth {
  static constexpr bool valid() { return false; }
};

// A point of a block as a weighted mean of nodes on its surface. An edge uses two of the three entries in 3-D and gives the
// third weight 0.
template <int dim>
struct Stencil {
  std::array<NodeId, dim> nodes;  // of the face that was found
  // The corner that a cell's quadrilateral has besides (both_diagonals.h), with the weight that the others lack of 1; not valid
  // elsewhere, where they sum to 1.
  [[no_unique_address]] std::conditional_t<dim == 3, NodeId, NoFourth> fourth{};
  std::array<double, dim> weights{};
};

// Calls `visit` with each node and its weight.
template <int dim, class Visit>
void for_each_weight(const Stencil<dim>& stencil, const Visit& visit) {
  for (int i = 0; i < dim; ++i) visit(stencil.nodes[i], stencil.weights[i]);
  if constexpr (dim == 3) {
    if (stencil.fourth.valid()) visit(stencil.fourth, 1 - (stencil.weights[0] + stencil.weights[1] + stencil.weights[2]));
  }
}

template <int dim>
Point<dim> point_of(const mesh::BlockMesh<dim>& mesh, const Stencil<dim>& stencil) {
  Point<dim> sum = Point<dim>::Zero();
  for_each_weight(stencil, [&](NodeId node, double weight) { sum += weight * mesh.nodes[node]; });
  return sum;
}

// There are many: in 3-D one fills two lines of a cache, and no part of a third. What follows from the rest is told by the
// functions below.
template <int dim>
struct alignas(dim == 3 ? 64 : alignof(double)) Contact {
  Kind kind = Kind::point_face;
  BlockId owner;            // of the semi-spring or semi-edge; of an overlap, the block of the lower face
  BlockId target;           // always another block than the owner
  ElementId owner_element;  // gives the characteristic length of eq. (11)
  ElementId target_element;
  Stencil<dim> on_owner;   // the contact point on the owner, by position
  Stencil<dim> on_target;  // the closest point on the target
  double area = 0;         // (9), (10), or the point's share of the overlap [m2] (2-D: times unit thickness)
  // Characteristic length of the owner's element. Of an overlap, which stands for the semi-springs of both sides:
  // 1/(1/dL1 + 1/dL2) [m].
  double length = 0;
  double gap = 0;  // signed distance from the target, negative inside it [m]
};
static_assert(sizeof(Contact<3>) == 128);

// Where it is: on the owner, or halfway through an overlap [m].
template <int dim>
Point<dim> point_of(const mesh::BlockMesh<dim>& mesh, const Contact<dim>& contact) {
  Point<dim> on_owner = point_of(mesh, contact.on_owner);
  if (contact.kind != Kind::overlap) return on_owner;
  return 0.5 * (on_owner + point_of(mesh, contact.on_target));
}

// Where the paper puts the owner's share of the flow: a semi-spring's vertex (12), a semi-edge's two vertices (13). An overlap
// has no vertex, and this is on_owner. A semi-spring or semi-edge is moved inwards by as much as the least of its weights, that
// of a corner which has no part in its vertices, tells; only semi-springs may have a fourth corner, which is no vertex.
template <int dim>
Stencil<dim> literal_owner(const Contact<dim>& contact) {
  Stencil<dim> owner = contact.on_owner;
  auto& weights = owner.weights;
  if (contact.kind == Kind::point_face) {
    const auto vertex = std::max_element(weights.begin(), weights.end()) - weights.begin();
    weights.fill(0);
    weights[static_cast<std::size_t>(vertex)] = 1;
  } else if (contact.kind == Kind::edge_edge) {
    const double inwards = *std::min_element(weights.begin(), weights.end());
    for (double& weight : weights) weight = (weight - inwards) / (1 - dim * inwards);
  }
  return owner;
}

template <int dim>
using Contacts = VectorWrittenLater<Contact<dim>>;

// Ordered by owner, owner's face, corner, and target, so that equal packings give equal sets; overlaps come after the others.
template <int dim>
struct ContactSet {
  Contacts<dim> contacts;
  std::size_t semi_springs = 0;  // all there are, with a target or without
  std::size_t semi_edges = 0;

  [[nodiscard]] std::size_t count(Kind kind) const {
    std::size_t n = 0;
    for (const auto& contact : contacts) n += contact.kind == kind ? 1 : 0;
    return n;
  }
};

}  // namespace scree::contact
