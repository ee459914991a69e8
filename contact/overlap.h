// The part of two faces that lies on each other, and its quadrature points. Pure geometry.
//
// Both faces are projected onto the plane halfway between them. Seen in it, the overlap is a convex polygon (2-D: a segment):
// one face clipped by the sides of the other (Sutherland and Hodgman, Communications of the ACM 17(1), 1974) and by the lines
// beyond which the gap is too wide. A point of it is given by its weights on both faces, in which everything here is linear.
#pragma once

#include <optional>
#include <vector>

#include "contact/face_point.h"

namespace scree::contact {

// Faces that lean more than this from lying on each other have no overlap: they touch in an edge or a corner, or look at each
// other through the tip of a block between them.
inline constexpr double least_opposed = 0.985;  // cosine of 10 degrees

template <int dim>
struct FacePair {
  Corners<dim> first;
  Corners<dim> second;
  Point<dim> normal;  // unit, of the plane halfway, from the first to the second
};

// Nothing for faces that do not look at each other. Normals are unit and outwards.
template <int dim>
std::optional<FacePair<dim>> opposed_faces(const Corners<dim>& first, const Point<dim>& first_normal,
                                           const Corners<dim>& second, const Point<dim>& second_normal) {
  if (first_normal.dot(second_normal) > -least_opposed) return std::nullopt;
  return FacePair<dim>{first, second, (first_normal - second_normal).normalized()};
}

template <int dim>
struct OverlapPoint {
  std::array<double, dim> on_first;  // weights of the corners
  std::array<double, dim> on_second;
  double area = 0;  // its share of the overlap [m2] (2-D: times unit thickness)
  double gap = 0;   // from the first to the second, negative where they overlap in depth [m]
};

// Points of equal shares, within the overlap, that integrate products of two linear functions exactly over the part of it in
// which the gap is at most `tolerance`, either way [m]: two in 2-D, three in 3-D whatever the polygon. Overlaps that are
// rounding only, 1e-13 of the smaller face, are left out.
template <int dim>
void overlap_points(const FacePair<dim>& pair, double tolerance, std::vector<OverlapPoint<dim>>& points);

}  // namespace scree::contact
