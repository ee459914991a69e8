// Fine search: does a semi-spring touch a target face, a semi-edge a target edge, and where.
#pragma once

#include <optional>

#include "contact/find_contacts.h"
#include "contact/point_touch.h"
#include "contact/surface.h"

namespace scree::contact {

template <int dim>
struct PointTouch {
  double gap = 0;                     // of the semi-spring, negative inside the target [m]
  double facing = 0;                  // cosine between the target's normal and the direction of the gap, for ties
  std::array<double, dim> on_target;  // weights
};

// A semi-spring, as a corner of a face, and a face.
struct PointAndFace {
  FaceId owner;
  int corner;
  FaceId target;
};

// Touching means: the semi-spring, or the vertex it stands for, is within tolerance of the target, and the owner's face looks
// at it.
template <int dim>
std::optional<PointTouch<dim>> touch_face(const Surface<dim>& surface, const ContactOptions& options, const PointAndFace& pair);

// The same in two steps, between which many may be measured at once. `weights`: of the owner's corners at the semi-spring.
template <int dim>
SCREE_INLINE PointQuery<dim, double> query_of(const Surface<dim>& surface, const std::array<double, dim>& weights,
                                              const PointAndFace& pair) {
  const auto corners = [&](FaceId face) SCREE_INLINED {
    const auto& nodes = surface.faces[face].nodes;
    CornerCoordinates<dim, double> at;
    for (int i = 0; i < dim; ++i) at[i] = coordinates<dim>(surface.mesh.nodes[nodes[i]]);
    return at;
  };
  const CornerCoordinates<dim, double> own = corners(pair.owner);
  return {weighted_point<dim, double>(own, weights),
          own[pair.corner],
          coordinates<dim>(surface.normals[pair.owner]),
          surface.lengths[pair.owner],
          corners(pair.target),
          coordinates<dim>(surface.normals[pair.target])};
}

// What the search knows of a target and a semi-spring.
struct KnownTarget {
  int plane;    // which vertex of its element the target is opposite to
  bool whole;   // its block has no other element
  bool inside;  // the semi-spring is known to be below the planes of all other faces of that element
};

// What is measured becomes of their touch: at the target's rim the direction comes from the faces around, and what is behind
// the target must be in its block. `point`: the semi-spring.
template <int dim>
std::optional<PointTouch<dim>> touch_of(const Surface<dim>& surface, const PointAndFace& pair, const KnownTarget& known,
                                        const Point<dim>& point, const PointAnswer<dim, double>& answer);

struct EdgeTouch {
  double gap = 0;        // of the semi-edge, negative inside the target [m]
  double along = 0;      // fraction of the way on the semi-edge
  double on_target = 0;  // fraction of the way on the target edge
};

// Corners of two blocks that are no further from each other, in characteristic lengths of the owner, are one: more than the
// rounding of a file, a hundredth of the tolerance.
inline constexpr double same_corner = 1e-4;

// Touching means: the semi-edge crosses the target edge between the ends of both, the strip between the semi-edge and the edge
// it stands for is within tolerance of it, the edges do not end in one corner, and along the gap both stand out from their
// blocks. The target edge must come within tolerance of the owner's face, and that face within the larger tolerance of the
// first face at the target edge.
std::optional<EdgeTouch> touch_edge(const Surface<3>& surface, const ContactOptions& options, FaceId owner, int side,
                                    EdgeId target);

}  // namespace scree::contact
