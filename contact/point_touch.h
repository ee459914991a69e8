// What touching means for a semi-spring and a target face, for one of them or several at once.
#pragma once

#include "contact/face_point.h"

namespace scree::contact {

// A face feels only what it looks at: the direction from which it is touched may lean at most 80 degrees from its normal.
// It must be more than 0 so that the joints which end on a free surface do not heat it from the side, by rounding or by a
// slight tilt; at 80 degrees a block that stands on a corner still touches with all the faces around it.
inline constexpr double least_facing = 0.17364817766693033;  // cos(80 degrees)

// Faces look at each other if the cosine between their normals is below minus this: perpendicular ones do not, however rounding
// turns them.
inline constexpr double least_opposed = 1e-9;

// Below this fraction of the characteristic length a difference of two points is rounding and has no direction.
inline constexpr double no_direction = 1e-9;

template <int dim, class Number>
struct PointQuery {
  Coordinates<dim, Number> point;   // the semi-spring
  Coordinates<dim, Number> vertex;  // that it stands for
  Coordinates<dim, Number> owner_normal;
  Number length;                           // characteristic, of the owner
  CornerCoordinates<dim, Number> corners;  // of the target
  Coordinates<dim, Number> target_normal;
};

template <int dim, class Number>
struct PointAnswer {
  std::array<Number, dim> on_target;  // weights of the closest point
  Coordinates<dim, Number> offset;    // from there to the semi-spring
  Number gap;                         // negative inside the target [m]
  Number facing;                      // cosine between the target's normal and the direction of the gap
  MaskOf<Number> near;                // whether they may touch; if not, the rest says nothing
  // The closest point is on the target's rim: gap and facing are still to be found from the faces around.
  MaskOf<Number> on_rim;
  MaskOf<Number> apart;  // far enough from each other for the difference to have a direction
};

// Whether the owner's face looks at what it touches from there.
template <int dim, class Number>
SCREE_INLINE MaskOf<Number> looks_at(const Coordinates<dim, Number>& owner_normal, const Coordinates<dim, Number>& direction) {
  return at_most(dot<dim>(direction, owner_normal), Number{} - least_facing);
}

// The semi-spring, or the vertex it stands for, must be within tolerance of the target, the two faces opposed, and the owner's
// must look at the target. Whether the point is within the target's block is not asked here. `rounding`: of the coordinates
// [m].
template <int dim, class Number>
SCREE_INLINE PointAnswer<dim, Number> measure(const PointQuery<dim, Number>& query, double tolerance, double rounding) {
  const Number zero{}, within = tolerance * query.length;
  PointAnswer<dim, Number> answer;
  answer.near = below(dot<dim>(query.target_normal, query.owner_normal), zero - least_opposed);
  const auto closest = closest_point<dim, Number>(query.corners, query.point);
  answer.on_target = closest.weights;
  const auto offset = minus<dim>(query.point, weighted_point<dim>(query.corners, closest.weights));
  answer.offset = offset;
  const Number distance = root(dot<dim>(offset, offset));
  const auto nearest = closest_point<dim, Number>(query.corners, query.vertex).weights;
  const auto beside = minus<dim>(query.vertex, weighted_point<dim>(query.corners, nearest));
  answer.near = answer.near & (at_most(distance, within) | at_most(root(dot<dim>(beside, beside)), within));

  answer.apart = below(no_direction * query.length, distance) & below(zero + rounding, distance);
  answer.on_rim = closest.on_rim & answer.apart;
  const Number height = dot<dim>(query.target_normal, minus<dim>(query.point, query.corners[0]));
  const Number signed_distance = chosen(below(dot<dim>(query.target_normal, offset), zero), -distance, distance);
  answer.gap = chosen(answer.apart, signed_distance, height);
  Coordinates<dim, Number> direction;  // of the gap, away from the target
  for (int i = 0; i < dim; ++i) direction[i] = chosen(answer.apart, offset[i] / answer.gap, query.target_normal[i]);
  // At the rim the gap's sign is not known yet, but whichever it is the owner's face must look along the offset.
  const Number along = dot<dim>(query.owner_normal, offset);
  constexpr double nearly = 1 - 1e-9;
  const auto may_look = at_most(nearly * least_facing * distance, chosen(below(along, zero), -along, along));
  answer.near = answer.near & ((answer.on_rim & may_look) | looks_at<dim>(query.owner_normal, direction));
  answer.facing = dot<dim>(direction, query.target_normal);
  return answer;
}

}  // namespace scree::contact
