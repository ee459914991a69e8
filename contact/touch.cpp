#include "contact/touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/segment.h"
#include "contact/semi_edge.h"
#include "contact/semi_spring.h"

namespace scree::contact {

namespace {

// How far, as a sine, a face may rise above its edge and the edge still count as standing out: packings are flat to that.
constexpr double flat_sine = 0.0175;  // 1 degree

// Does the face on one side of an edge rise above it in a direction, unit and perpendicular to the edge?
bool rises(const Surface<3>& surface, FaceId face, const SurfaceEdge& edge, const Eigen::Vector3d& direction) {
  const Point<3>& start = surface.mesh.nodes[edge.nodes[0]];
  const Eigen::Vector3d along = surface.mesh.nodes[edge.nodes[1]] - start;
  Eigen::Vector3d inwards = surface.normals[face].cross(along);
  const Corners<3> corners = corners_of(surface, face);
  if ((corners[0] + corners[1] + corners[2] - 3 * start).dot(inwards) < 0) inwards = -inwards;
  const double rise = inwards.dot(direction);
  return rise > 0 && rise * rise > flat_sine * flat_sine * inwards.squaredNorm();
}

bool stands_out(const Surface<3>& surface, const SurfaceEdge& edge, const Eigen::Vector3d& direction) {
  return !rises(surface, edge.faces[0], edge, direction) && !rises(surface, edge.faces[1], edge, direction);
}

// Does what these points span come within a distance of the face's plane?
template <std::size_t count>
bool comes_near(const Surface<3>& surface, FaceId face, const std::array<Point<3>, count>& points, double distance) {
  const Point<3>& corner = surface.mesh.nodes[surface.faces[face].nodes[0]];
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point<3>& point : points) {
    const double height = surface.normals[face].dot(point - corner);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return low <= distance && high >= -distance;
}

}  // namespace

template <int dim>
std::optional<PointTouch<dim>> touch_of(const Surface<dim>& surface, const PointAndFace& pair, const KnownTarget& known,
                                        const Point<dim>& point, const PointAnswer<dim, double>& answer) {
  if (answer.near == 0) return std::nullopt;
  PointTouch<dim> touch{answer.gap, answer.facing, answer.on_target};
  if (answer.on_rim != 0) {
    const Eigen::Map<const Point<dim>> offset(answer.offset.data());
    const bool behind = rise_at_rim<dim>(surface, {pair.target, known.plane, known.whole}, answer.on_target, offset) < 0;
    touch.gap = behind ? -offset.norm() : offset.norm();
    const Point<dim> direction = offset / touch.gap;
    if (direction.dot(surface.normals[pair.owner]) > -least_facing) return std::nullopt;
    touch.facing = direction.dot(surface.normals[pair.target]);
  }
  // Behind this face need not be inside: it may be beyond the far side of a thin block.
  const bool asked = touch.gap < 0 && answer.apart != 0 && !known.inside;
  const mesh::Face<dim>& target = surface.faces[pair.target];
  if (asked && !surface.blocks->hold(target.block, target.element, point)) return std::nullopt;
  return touch;
}

template <int dim>
std::optional<PointTouch<dim>> touch_face(const Surface<dim>& surface, const ContactOptions& options,
                                          const PointAndFace& pair) {
  const auto query = query_of<dim>(surface, semi_spring_weights<dim>(pair.corner, options.indentation), pair);
  const KnownTarget known{opposite_vertex(surface, pair.target), is_whole(surface.mesh, surface.faces[pair.target].block),
                          false};
  return touch_of<dim>(surface, pair, known, Eigen::Map<const Point<dim>>(query.point.data()),
                       measure(query, options.tolerance, surface.rounding));
}

std::optional<EdgeTouch> touch_edge(const Surface<3>& surface, const ContactOptions& options, FaceId owner, int side,
                                    EdgeId target) {
  const double tolerance = options.tolerance * surface.lengths[owner];
  const SurfaceEdge& other = surface.edges[target];
  const Corners<3> own = corners_of(surface, owner);
  const Point<3>&target_start = surface.mesh.nodes[other.nodes[0]], &target_end = surface.mesh.nodes[other.nodes[1]];
  // The lines may come within tolerance beyond the end of an edge, where there is nothing: then one of these is too far off.
  const FaceId beside = other.faces[0];
  const double reach = options.tolerance * std::max(surface.lengths[owner], surface.lengths[beside]);
  if (!comes_near<2>(surface, owner, {target_start, target_end}, tolerance)) return std::nullopt;
  if (!comes_near<3>(surface, beside, own, reach)) return std::nullopt;

  const Point<3> start = weighted_point<3>(own, semi_edge_weights(side, 0, options.indentation));
  const Point<3> end = weighted_point<3>(own, semi_edge_weights(side, 1, options.indentation));
  const auto crossing = line_crossing(start, end, target_start, target_end);
  if (!crossing || crossing->along_a < 0 || crossing->along_a > 1 || crossing->along_b < 0 || crossing->along_b > 1) {
    return std::nullopt;
  }

  Eigen::Vector3d direction = crossing->normal;  // of the gap, away from the target
  if (direction.dot(surface.normals[other.faces[0]] + surface.normals[other.faces[1]]) < 0) direction = -direction;
  if (direction.dot(surface.normals[owner]) > -least_facing) return std::nullopt;

  // The edge itself is parallel to its semi-edge, so one normal measures both gaps.
  const double gap = direction.dot(start - target_start);
  const double true_gap = direction.dot(own[side] - target_start);
  if (std::abs(gap) > tolerance && std::abs(true_gap) > tolerance) return std::nullopt;

  // Edges that end in one corner, as in a mesh that conforms, cross there by rounding at most.
  const double rounding = same_corner * surface.lengths[owner];
  for (const Point<3>* mine : {&own[side], &own[(side + 1) % 3]}) {
    for (const Point<3>* its : {&target_start, &target_end}) {
      if ((*mine - *its).squaredNorm() <= rounding * rounding) return std::nullopt;
    }
  }

  const SurfaceEdge& own_edge = surface.edges[surface.face_edges[owner][side]];
  if (!stands_out(surface, other, direction) || !stands_out(surface, own_edge, -direction)) return std::nullopt;
  return EdgeTouch{gap, crossing->along_a, crossing->along_b};
}

#define SCREE_INSTANTIATE(dim)                                                                                        \
  template std::optional<PointTouch<dim>> touch_of<dim>(const Surface<dim>&, const PointAndFace&, const KnownTarget&, \
                                                        const Point<dim>&, const PointAnswer<dim, double>&);          \
  template std::optional<PointTouch<dim>> touch_face<dim>(const Surface<dim>&, const ContactOptions&, const PointAndFace&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
