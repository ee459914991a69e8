#include "engine/packing/touching_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace scree::packing {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The corners of a face, the ends of an edge, or a vertex.
using Feature = std::vector<Vector3d>;

std::size_t foremost(const PlacedPiece& piece, const Vector3d& outwards) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < piece.vertices.size(); ++i) {
    if (outwards.dot(piece.vertices[i]) > outwards.dot(piece.vertices[best])) best = i;
  }
  return best;
}

// What of a piece takes part in a contact across a plane.
Feature feature_towards(const PlacedPiece& piece, const Vector3d& outwards, double lean) {
  double best = std::cos(lean);
  Feature feature;
  for (std::size_t f = 0; f < piece.normals.size(); ++f) {
    const double aligned = piece.normals[f].dot(outwards);
    if (aligned < best || piece.piece->faces[f].inner) continue;
    best = aligned;
    feature.clear();
    for (const std::int32_t corner : piece.piece->faces[f].corners) feature.push_back(piece.vertices[corner]);
  }
  if (!feature.empty()) return feature;
  const std::size_t front = foremost(piece, outwards);
  double least = std::sin(lean);
  feature = {piece.vertices[front]};
  for (const auto& edge : piece.piece->edges) {
    const auto first = static_cast<std::size_t>(edge.corners[0]);
    const auto second = static_cast<std::size_t>(edge.corners[1]);
    if (first != front && second != front) continue;
    const double slope = std::abs((piece.vertices[second] - piece.vertices[first]).normalized().dot(outwards));
    if (slope > least) continue;
    least = slope;
    feature = {piece.vertices[first], piece.vertices[second]};
  }
  return feature;
}

std::vector<Vector2d> seen_along(const Vector3d& direction, const Feature& feature) {
  const Vector3d across = direction.unitOrthogonal();
  const Vector3d up = direction.cross(across);
  std::vector<Vector2d> points;
  points.reserve(feature.size());
  for (const Vector3d& corner : feature) points.emplace_back(across.dot(corner), up.dot(corner));
  return points;
}

double overlap_along(const Vector2d& axis, const std::vector<Vector2d>& a, const std::vector<Vector2d>& b) {
  const auto extent = [&](const std::vector<Vector2d>& points) {
    std::pair<double, double> range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (const Vector2d& point : points) {
      range.first = std::min(range.first, axis.dot(point));
      range.second = std::max(range.second, axis.dot(point));
    }
    return range;
  };
  const auto [low_a, high_a] = extent(a);
  const auto [low_b, high_b] = extent(b);
  return std::min(high_a - low_b, high_b - low_a);
}

// How far one of two convex figures in a plane would have to move to leave the other; negative if they are apart.
double depth_in_plane(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b) {
  double depth = std::numeric_limits<double>::infinity();
  for (const auto* figure : {&a, &b}) {
    for (std::size_t i = 0; i < figure->size(); ++i) {
      const Vector2d side = (*figure)[(i + 1) % figure->size()] - (*figure)[i];
      depth = std::min(depth, overlap_along(Vector2d(-side.y(), side.x()).normalized(), a, b));
    }
  }
  return depth;
}

Meeting meeting_of(const Part& a, const Part& b, const Vector3d& normal, const TouchOptions& options) {
  Feature large = feature_towards(a.placed, normal, options.lean);
  Feature small = feature_towards(b.placed, -normal, options.lean);
  if (large.size() < small.size()) std::swap(large, small);
  if (small.size() == 1) {
    return large.size() > 2 ? Meeting::face_point : large.size() == 2 ? Meeting::edge_point : Meeting::point_point;
  }
  if (large.size() == 2) return Meeting::edge_edge;
  if (depth_in_plane(seen_along(normal, large), seen_along(normal, small)) <= options.range) return Meeting::edge_edge;
  return small.size() == 2 ? Meeting::face_edge : Meeting::face_face;
}

}  // namespace

std::vector<TouchingPair> touching_pairs(const PieceSet& pieces, const TouchOptions& options) {
  std::map<std::pair<BlockId, BlockId>, TouchingPair> found;
  for (const auto& [a, b] : near_pairs(pieces.parts, options.range)) {
    const Separation between = separation(a->placed, b->placed, options.range);
    if (between.distance > options.range) continue;
    const auto [first, second] = std::minmax(a->block, b->block);
    const TouchingPair touching{first, second, meeting_of(*a, *b, between.normal, options), between.distance};
    const auto [known, is_new] = found.try_emplace({first, second}, touching);
    if (is_new) continue;
    known->second.meeting = std::min(known->second.meeting, touching.meeting);
    known->second.gap = std::min(known->second.gap, touching.gap);
  }
  std::vector<TouchingPair> result;
  result.reserve(found.size());
  for (const auto& [pair, touching] : found) result.push_back(touching);
  return result;
}

}  // namespace scree::packing
