#include "engine/packing/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::packing {

namespace {

using Eigen::Vector3d;
using Feature = Separation::Feature;

double face_distance(const PlacedPiece& owner, std::int32_t face, const PlacedPiece& other) {
  const Vector3d& normal = owner.normals[face];
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& vertex : other.vertices) least = std::min(least, normal.dot(vertex));
  return least - normal.dot(owner.vertices[owner.piece->faces[face].corners[0]]);
}

// Returns true if the pieces are more than `enough` apart.
template <class Allowed>
bool best_face(const PlacedPiece& owner, const PlacedPiece& other, Feature feature, double enough, const Allowed& allowed,
               Separation& best) {
  for (std::size_t f = 0; f < owner.normals.size(); ++f) {
    const auto face = static_cast<std::int32_t>(f);
    const double distance = face_distance(owner, face, other);
    if (distance <= best.distance) continue;
    const Vector3d normal = feature == Feature::face_of_first ? owner.normals[f] : Vector3d(-owner.normals[f]);
    const Separation found{distance, normal, feature, face, face};
    if (!allowed(found)) continue;
    best = found;
    if (distance > enough) return true;
  }
  return false;
}

struct EdgeArc {
  Vector3d from;         // a point of the edge
  Vector3d direction;    // along it, not unit
  const Vector3d& left;  // normals of its two faces
  const Vector3d& right;
};

EdgeArc arc(const PlacedPiece& placed, std::size_t edge) {
  const auto& e = placed.piece->edges[edge];
  const Vector3d& from = placed.vertices[e.corners[0]];
  return {from, placed.vertices[e.corners[1]] - from, placed.normals[e.faces[0]], placed.normals[e.faces[1]]};
}

// Do the arcs left-right of `a` and -left to -right of `b` cross on the unit sphere?
bool arcs_cross(const EdgeArc& a, const EdgeArc& b) {
  const double left_b = -b.left.dot(a.direction);
  const double right_b = -b.right.dot(a.direction);
  if (left_b * right_b >= 0) return false;
  const double left_a = a.left.dot(b.direction);
  const double right_a = a.right.dot(b.direction);
  // An edge's direction is left x right times a positive number.
  return left_a * right_a < 0 && left_b * right_a > 0;
}

// From the edge of the first towards that of the second, along their common perpendicular that points out of the first.
bool edge_axis(const EdgeArc& a, const EdgeArc& b, Vector3d& normal) {
  normal = a.direction.cross(b.direction);
  const double length_sq = normal.squaredNorm();
  if (length_sq < 1e-16 * a.direction.squaredNorm() * b.direction.squaredNorm()) return false;
  normal /= std::sqrt(length_sq);
  if (normal.dot(a.left + a.right) < 0) normal = -normal;
  return true;
}

template <class Allowed>
Separation best_separation(const PlacedPiece& first, const PlacedPiece& second, double enough, double face_bias,
                           const Allowed& allowed) {
  Separation best;
  best.distance = -std::numeric_limits<double>::infinity();
  if (best_face(first, second, Feature::face_of_first, enough, allowed, best)) return best;
  if (best_face(second, first, Feature::face_of_second, enough, allowed, best)) return best;
  double to_beat = best.distance + face_bias;
  for (std::size_t i = 0; i < first.piece->edges.size(); ++i) {
    const EdgeArc a = arc(first, i);
    for (std::size_t j = 0; j < second.piece->edges.size(); ++j) {
      const EdgeArc b = arc(second, j);
      Vector3d normal;
      if (!arcs_cross(a, b) || !edge_axis(a, b, normal)) continue;
      const double distance = normal.dot(b.from - a.from);
      if (distance <= to_beat) continue;
      const Separation found{distance, normal, Feature::edges, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
      if (!allowed(found)) continue;
      to_beat = distance;
      best = found;
      if (distance > enough) return best;
    }
  }
  return best;
}

}  // namespace

PlacedPiece placed(const mesh::ConvexPiece& piece, const Pose& pose) {
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  PlacedPiece result{&piece, {}, {}};
  result.vertices.reserve(piece.vertices.size());
  result.normals.reserve(piece.faces.size());
  for (const Vector3d& vertex : piece.vertices) result.vertices.emplace_back(rotation * vertex + pose.translation);
  for (const auto& face : piece.faces) result.normals.emplace_back(rotation * face.normal);
  return result;
}

Separation separation(const PlacedPiece& first, const PlacedPiece& second, double enough, double face_bias) {
  return best_separation(first, second, enough, face_bias, [](const Separation&) { return true; });
}

Separation separation_by(const PlacedPiece& first, const PlacedPiece& second, double face_bias,
                         const std::function<bool(const Separation&)>& allowed) {
  return best_separation(first, second, std::numeric_limits<double>::infinity(), face_bias, allowed);
}

double separation_along(const PlacedPiece& first, const PlacedPiece& second, const Separation& earlier) {
  if (earlier.feature == Feature::face_of_first) return face_distance(first, earlier.of_first, second);
  if (earlier.feature == Feature::face_of_second) return face_distance(second, earlier.of_second, first);
  const EdgeArc a = arc(first, earlier.of_first);
  const EdgeArc b = arc(second, earlier.of_second);
  Vector3d normal;
  if (!arcs_cross(a, b) || !edge_axis(a, b, normal)) return -std::numeric_limits<double>::infinity();
  return normal.dot(b.from - a.from);
}

}  // namespace scree::packing
