// How far the temperature of a block leaves its mean when heat enters it somewhere: what a lumped block leaves out.
//
// Heat that enters at unit rate through a patch and is stored evenly makes, once the first instants have passed, the field
//   -div(k grad G) = -1/V,   k n.grad G = the patch's density of heat flow,   mean G = 0    [K/W].
// Ritz's method with the polynomials of first and second degree about the centroid is exact for a bar or slab heated at its
// ends, a sphere heated all over and an ellipsoid alike; it needs the volume, the centroid and the second moments M of the
// block, no mesh of its inside. With m = mean of x x^T over the patch,
//   G = (k^-1 mean(x)/V).x + x.B x - tr(B M)/V,   k B M + M B k = (m - M/V)/2.
// In a block with dents the path of heat is no polynomial of place: there G is found on the block's mesh (inner_field.h).
// What a small patch adds is the constriction of the flow lines near it (Cooper, Mikic and Yovanovich, Int. J. Heat Mass
// Transfer 12, 1969): in 3-D psi/(4 k r), r the radius of a circle as large as the patch, psi = (1 - r/b)^1.5, b that of a
// circle as large as the surface; in 2-D ln(1/sin(pi/2 of the share of the perimeter))/(pi k) (Yovanovich, in Handbook of Heat
// Transfer, 1998). The surface is that of a ball of the block's volume, k the lowest principal conductivity. Heat set free in a
// part of the volume is taken for that of a ball of radius a in the middle of that ball of radius b, which it makes warmer than
// the rim by 3/(8 pi k) (1/a - 1/b), in 2-D by ln(b/a)/(2 pi k).
#pragma once

#include <optional>

#include <Eigen/Eigenvalues>

#include "contact/contact_set.h"
#include "thermal/inner_field.h"

namespace scree::thermal {

// Where heat enters: sums over the patch, weighted by how well each point conducts.
template <int dim>
struct PatchMoments {
  double weight = 0;                         // of all points
  Point<dim> first = Point<dim>::Zero();     // sum of weight times x, about the block's centroid [m]
  Tensor<dim> second = Tensor<dim>::Zero();  // sum of weight times x x^T [m2]
  Eigen::VectorXd at_nodes;                  // of a block with dents the weight at each of its nodes

  void add(const Point<dim>& from_centroid, double with_weight) {
    weight += with_weight;
    first += with_weight * from_centroid;
    second += with_weight * from_centroid * from_centroid.transpose();
  }
};

template <int dim>
class InnerResistance {
 public:
  // Conductivity in W/m/K. Refers to the mesh.
  InnerResistance(const mesh::BlockMesh<dim>& mesh, BlockId block, const Tensor<dim>& conductivity);

  [[nodiscard]] const Point<dim>& centroid() const { return centroid_; }
  [[nodiscard]] double volume() const { return volume_; }

  // Adds a node of the block, or a point of its surface, to a patch.
  void add(NodeId node, double weight, PatchMoments<dim>& patch) const;
  void add(const contact::Stencil<dim>& point, double weight, PatchMoments<dim>& patch) const;

  // Largest |G| at a node of the block [K/W]; 0 for an empty patch.
  [[nodiscard]] double bulk(const PatchMoments<dim>& patch) const;

  // Of a patch of this area [m2]; nothing constricts the flow through one as large as the surface [K/W].
  [[nodiscard]] double constriction(double area) const;

  // Of a part of this volume [m3] in which heat is set free; nothing if it is all of it [K/W].
  [[nodiscard]] double constriction_within(double volume) const;

 private:
  [[nodiscard]] static double radius_of(double volume);  // of a ball [m]
  void add_at_node(NodeId node, double weight, PatchMoments<dim>& patch) const;

  const mesh::BlockMesh<dim>& mesh_;
  const mesh::Block& block_;
  Tensor<dim> conductivity_;
  double lowest_conductivity_;                                 // of the principal ones
  Point<dim> centroid_ = Point<dim>::Zero();                   // [m]
  double volume_ = 0;                                          // [m3]
  Tensor<dim> moments_ = Tensor<dim>::Zero();                  // integral of x x^T about the centroid [m5]
  std::optional<InnerField<dim>> field_;                       // of a block with dents
  Tensor<dim> inverse_root_;                                   // of Cholesky's root of the conductivity
  Eigen::SelfAdjointEigenSolver<Tensor<dim>> scaled_moments_;  // by that from both sides
};

}  // namespace scree::thermal
