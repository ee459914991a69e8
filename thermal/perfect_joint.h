// Perfect joints of meshes that do not match: no knob, and a linear field passes exactly.
//
// Nitsche's coupling, as in symmetric interior-penalty methods. On an overlap, with [T] = T1 - T2 and n from side 1 to side 2,
// the joint's energy is
//   integral of  gamma [T]^2 - 2 [T] q,    q = w1 n.k1 grad T1 + w2 n.k2 grad T2,    w1 + w2 = 1,
// so heat gamma [T] - q flows from 1 to 2 per area: the flux of both sides' mean and, against the jump, a penalty.
//
// The penalty follows from a bound, not from a user. On a linear simplex grad T is constant, so that over the overlaps of an
// element, of area S in all, integral (n.k grad T)^2 <= c * (the element's energy), c = S (n.k n)/V; with equality for one flat
// side (the trace inequality of Warburton and Hesthaven, Comput. Methods Appl. Mech. Eng. 192, 2003, at order 0; for interior
// penalties K. Shahbazi, J. Comput. Phys. 205, 2005). Then
//   w1 = c2/(c1 + c2),   w2 = c1/(c1 + c2),   gamma = 2 c1 c2/(c1 + c2)
// leave at least half of every block's own energy, and K is positive semidefinite with the constants as its kernel. The weights
// are those that need the least penalty (Annavarapu, Hautefeuille and Dolbow, Comput. Methods Appl. Mech. Eng. 225-228, 2012);
// they stay good when the two sides differ a thousandfold.
//
// Where a condition holds the nodes of one side, or heats its face, the normal flux is not continuous: what is given to or
// taken from the joint itself comes on top. The other side's flux then counts alone, w = 1 and gamma = 2 c of that side, and
// the joint is exact again for linear fields. With the mean flux the side that is driven by g would part from the other by g/(2
// c) of its own c, which is much where it conducts badly.
//
// Where a block is made of cells, its conduction is that of two splits with half the weight each (engine/mesh/cells.h), and q
// is the mean of the two simplices behind the face. The square of a mean is at most the mean of the squares, so the bounds add
// up to the block's energy as they do above, with c the larger of the two. A face that is seen through one diagonal has one
// simplex behind it, whose bound counts twice.
//
// Where k depends on temperature, both sides of one material: all of this in Kirchhoff's Phi, the integral of k over T, in
// which the flux is linear. One side constant: its flux alone, w = 1 and gamma = 2 c, as if the other conducted without end;
// heat then flows as the constant side says, also if that one is driven, and a linear field in either passes. Two materials
// whose k depends on temperature have neither, and are refused.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "contact/contact_set.h"
#include "engine/base/material.h"
#include "thermal/joint_options.h"

namespace scree::thermal {

// What a quadrature point of a perfect joint adds to a contact's g w w^T: the mean flux q times the point's area is
// sum of flux times temperatures [W], and K loses w q^T + q w^T.
struct PerfectTerm {
  std::size_t contact = 0;  // in the set
  double penalty = 0;       // gamma [W/m2/K]
  // Where both sides are of one material whose k depends on temperature: 1/k at the reference temperature, times which all of
  // the term is about Phi instead of T [m K/W].
  std::optional<double> of_phi;
  MaterialId material;      // of the owner
  std::size_t first = 0;    // of its nodes
  std::uint8_t owners = 0;  // how many of them are the owner's; they come first
  std::uint8_t size = 0;
};

// The nodes of a term, each once: corners of the simplices behind the owner's face, then behind the target's.
struct PerfectNodes {
  std::span<const NodeId> nodes;
  std::span<const double> jump;  // w: T1 - T2
  std::span<const double> flux;  // [W/K]
  std::size_t owners;

  [[nodiscard]] std::size_t size() const { return nodes.size(); }
};

// In the order of their contacts.
struct PerfectTerms {
  // The two simplices behind a cell's face have two corners in common, or more.
  static constexpr std::size_t most_nodes = 12;

  std::vector<PerfectTerm> terms;
  // Of all terms, one after the other.
  std::vector<NodeId> nodes;
  std::vector<double> jump, flux;

  [[nodiscard]] PerfectNodes nodes_of(const PerfectTerm& term) const {
    const auto part = [&](const auto& of_all) { return std::span(of_all).subspan(term.first, term.size); };
    return {part(nodes), part(jump), part(flux), term.owners};
  }
};

// Of each node whether a condition holds it or heats it through a face; empty: of none.
using DrivenNodes = Table<NodeId, std::uint8_t>;

// One for each contact of a perfect joint. Throws InputError for one between two materials whose conductivities depend on
// temperature.
template <int dim>
PerfectTerms perfect_terms(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                           const contact::ContactSet<dim>& contacts, const JointOptions& joint, const DrivenNodes& driven);

}  // namespace scree::thermal
