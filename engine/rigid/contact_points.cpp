#include "engine/rigid/contact_points.h"

#include <algorithm>
#include <cmath>

namespace scree::rigid {

namespace {

using Eigen::Vector3d;
using packing::PlacedPiece;
using packing::Separation;
using Polygon = std::vector<Vector3d>;

std::size_t most_opposed_face(const PlacedPiece& piece, const Vector3d& normal) {
  return static_cast<std::size_t>(
      std::min_element(piece.normals.begin(), piece.normals.end(),
                       [&](const Vector3d& a, const Vector3d& b) { return a.dot(normal) < b.dot(normal); }) -
      piece.normals.begin());
}

// Keeps what lies behind the plane through `on` (Sutherland and Hodgman).
void clip(Polygon& polygon, Polygon& scratch, const Vector3d& on, const Vector3d& outwards) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& from = polygon[i];
    const Vector3d& to = polygon[(i + 1) % polygon.size()];
    const double from_height = outwards.dot(from - on);
    const double to_height = outwards.dot(to - on);
    if (from_height <= 0) scratch.push_back(from);
    if ((from_height < 0 && to_height > 0) || (from_height > 0 && to_height < 0)) {
      scratch.push_back(from + from_height / (from_height - to_height) * (to - from));
    }
  }
  polygon.swap(scratch);
}

// The candidate for which `value` is largest, moved to the end of those already chosen.
template <class Value>
void choose(std::vector<ContactPoint>& points, std::ptrdiff_t chosen, Value value) {
  const auto best = std::max_element(points.begin() + chosen, points.end(),
                                     [&](const ContactPoint& a, const ContactPoint& b) { return value(a) < value(b); });
  std::iter_swap(points.begin() + chosen, best);
}

// Deepest, farthest from it, and the two that make the largest triangles on either side of the line between them.
void reduce_to_four(std::vector<ContactPoint>& points, const Vector3d& normal) {
  choose(points, 0, [](const ContactPoint& p) { return -p.distance; });
  const Vector3d first = points[0].on_first;
  choose(points, 1, [&](const ContactPoint& p) { return (p.on_first - first).squaredNorm(); });
  const Vector3d across = normal.cross(points[1].on_first - first);
  choose(points, 2, [&](const ContactPoint& p) { return across.dot(p.on_first - first); });
  choose(points, 3, [&](const ContactPoint& p) { return -across.dot(p.on_first - first); });
  points.resize(4);
}

// Of the vertex that is the furthest against the face's normal.
ContactPoint deepest_point(const PlacedPiece& reference, std::int32_t face, const PlacedPiece& incident) {
  const Vector3d& normal = reference.normals[face];
  const Vector3d& deepest =
      *std::min_element(incident.vertices.begin(), incident.vertices.end(),
                        [&](const Vector3d& a, const Vector3d& b) { return a.dot(normal) < b.dot(normal); });
  const double distance = normal.dot(deepest - reference.vertices[reference.piece->faces[face].corners[0]]);
  return {deepest - distance * normal, deepest, distance};
}

// Whether it lies over the face, seen along the face's normal.
bool is_over(const PlacedPiece& piece, std::int32_t face, const Vector3d& point) {
  const auto& rim = piece.piece->faces[face].corners;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector3d& from = piece.vertices[rim[i]];
    const Vector3d& to = piece.vertices[rim[(i + 1) % rim.size()]];
    if ((to - from).cross(piece.normals[face]).dot(point - from) > 0) return false;
  }
  return true;
}

// Of a polygon that is much longer than wide; less of others.
double width(const Polygon& polygon) {
  Vector3d twice_area = Vector3d::Zero();
  double length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& next = polygon[(i + 1) % polygon.size()];
    length += 0.5 * (next - polygon[i]).norm();
    twice_area += (polygon[i] - polygon[0]).cross(next - polygon[0]);
  }
  return length > 0 ? 0.5 * twice_area.norm() / length : 0;
}

// Points of `incident` against a face of `reference`, `apart` from it; the reference's points come first.
std::vector<ContactPoint> face_points(const PlacedPiece& reference, std::int32_t face, const PlacedPiece& incident,
                                      double apart, const ContactReach& reach) {
  const auto [range, clearance, rim_width] = reach;
  const Vector3d& normal = reference.normals[face];
  const auto& rim = reference.piece->faces[face].corners;
  Polygon polygon;
  Polygon scratch;
  const std::size_t opposed = most_opposed_face(incident, normal);
  for (const std::int32_t corner : incident.piece->faces[opposed].corners) {
    polygon.push_back(incident.vertices[corner]);
  }
  for (std::size_t i = 0; i < rim.size() && !polygon.empty(); ++i) {
    const Vector3d& from = reference.vertices[rim[i]];
    const Vector3d& to = reference.vertices[rim[(i + 1) % rim.size()]];
    clip(polygon, scratch, from, (to - from).cross(normal));
  }
  std::vector<ContactPoint> points;
  // A clearance keeps what lies flush apart already, and is kept by all.
  const double least_apart = clearance > 0 ? clearance : -rim_width;
  if (!polygon.empty() && apart > least_apart && width(polygon) < rim_width) return points;
  for (const Vector3d& point : polygon) {
    const double distance = normal.dot(point - reference.vertices[rim[0]]);
    if (distance <= range) points.push_back({point - distance * normal, point, distance});
  }
  const bool bears =
      clearance > 0 ? std::any_of(points.begin(), points.end(), [&](const ContactPoint& p) { return p.distance < clearance; })
                    : !points.empty();
  // An overlap without a contact would grow unseen, and what is closer than the clearance come closer. It has none if the face
  // that was clipped does not hold the deepest vertex, which is one overlap in a thousand. Other points of the pair bear an
  // overlap as well as the deepest (README.md); a clearance they do not keep. And of two faces that are nearly one the most
  // opposed may not hold the deepest vertex, which then bears the pair beside it.
  if (!bears || incident.piece->faces[opposed].bent) {
    const ContactPoint deepest = deepest_point(reference, face, incident);
    const auto is_higher = [&](const ContactPoint& p) { return p.distance > deepest.distance; };
    const bool missed =
        !bears || (is_over(reference, face, deepest.on_second) && std::all_of(points.begin(), points.end(), is_higher));
    if (missed && deepest.distance < clearance) points.push_back(deepest);
  }
  if (points.size() > 4) reduce_to_four(points, normal);
  return points;
}

ContactPoint edge_point(const PlacedPiece& first, const PlacedPiece& second, const Separation& separation) {
  const auto& a = first.piece->edges[separation.of_first].corners;
  const auto& b = second.piece->edges[separation.of_second].corners;
  const Vector3d& from = first.vertices[a[0]];
  const Vector3d along = first.vertices[a[1]] - from;
  const Vector3d& other = second.vertices[b[0]];
  const Vector3d other_along = second.vertices[b[1]] - other;
  // Where the first edge meets the plane through the second that holds the normal.
  const Vector3d plane = other_along.cross(separation.normal);
  const double at = std::clamp(plane.dot(other - from) / plane.dot(along), 0.0, 1.0);
  const Vector3d on_first = from + at * along;
  return {on_first, on_first + separation.distance * separation.normal, separation.distance};
}

}  // namespace

ContactPoints contact_points(const PlacedPiece& first, const PlacedPiece& second, const Separation& separation,
                             const ContactReach& reach) {
  ContactPoints result;
  if (separation.feature == Separation::Feature::edges) {
    result.points[result.count++] = edge_point(first, second, separation);
    return result;
  }
  const bool of_first = separation.feature == Separation::Feature::face_of_first;
  for (ContactPoint point : of_first ? face_points(first, separation.of_first, second, separation.distance, reach)
                                     : face_points(second, separation.of_second, first, separation.distance, reach)) {
    if (!of_first) std::swap(point.on_first, point.on_second);
    result.points[result.count++] = point;
  }
  return result;
}

}  // namespace scree::rigid
