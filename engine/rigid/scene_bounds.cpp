#include "engine/rigid/scene_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/mesh/convex_pieces.h"

namespace scree::rigid {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_fixed(const mesh::BlockMesh<3>& mesh, BlockId block) {
  return mesh.bodies[mesh.blocks[block].body].fixed;
}

constexpr double beside = 1e-6;    // of a piece's size, by which a vertical may miss it and counts still: blocks lie flush
constexpr double vertical = 1e-6;  // slope of a face that no vertical enters or leaves by

// Height above `from` (negative: below) at which the vertical through it leaves the piece upwards; nothing if it misses.
std::optional<double> upper_hit(const mesh::ConvexPiece& piece, const Eigen::Vector3d& from, const Eigen::Vector3d& up) {
  Aabb<3> box;
  for (const auto& vertex : piece.vertices) box.extend(vertex);
  const double slack = beside * box.diagonal().norm();
  double enter = -infinity;  // the piece with a skin of that much
  double leave = infinity;
  double upper = infinity;  // without
  for (const auto& face : piece.faces) {
    const double height = face.normal.dot(from - piece.vertices[face.corners[0]]);
    const double slope = face.normal.dot(up);
    if (std::abs(slope) <= vertical) {
      if (height > slack) return std::nullopt;
    } else if (slope > 0) {
      leave = std::min(leave, (slack - height) / slope);
      upper = std::min(upper, -height / slope);
    } else {
      enter = std::max(enter, (slack - height) / slope);
    }
  }
  if (enter > leave) return std::nullopt;
  return upper;
}

}  // namespace

SceneBounds::SceneBounds(const mesh::BlockMesh<3>& mesh, const Eigen::Vector3d& gravity) {
  for (const auto& node : mesh.nodes) box_.extend(node);
  const double diagonal = box_.diagonal().norm();
  if (!gravity.isZero()) up_ = -gravity.normalized();
  floor_ = infinity;
  for (const BlockId block : mesh.blocks.ids()) {
    if (!is_fixed(mesh, block)) continue;
    for (const NodeId node : mesh.blocks[block].nodes) floor_ = std::min(floor_, up_.dot(mesh.nodes[node]));
  }
  floor_ = floor_ < infinity && !up_.isZero() ? floor_ - 0.1 * diagonal : -infinity;
  box_.min().array() -= 10 * diagonal;
  box_.max().array() += 10 * diagonal;
}

bool SceneBounds::lost(const Eigen::Vector3d& centre, double radius) const {
  return up_.dot(centre) + radius < floor_ || !box_.contains(centre);
}

double pile_top(const mesh::BlockMesh<3>& placed, const Eigen::Vector3d& gravity, const std::vector<BlockId>& except) {
  if (gravity.isZero()) return 0;
  const Eigen::Vector3d up = -gravity.normalized();
  Eigen::Vector3d top = Eigen::Vector3d::Zero();
  double height = -infinity;
  for (const BlockId block : placed.blocks.ids()) {
    if (is_fixed(placed, block) || std::binary_search(except.begin(), except.end(), block)) continue;
    for (const NodeId node : placed.blocks[block].nodes) {
      if (up.dot(placed.nodes[node]) <= height) continue;
      top = placed.nodes[node];
      height = up.dot(top);
    }
  }
  double under = -infinity;
  double any = -infinity;
  for (const BlockId block : placed.blocks.ids()) {
    if (!is_fixed(placed, block)) continue;
    for (const NodeId node : placed.blocks[block].nodes) {
      if (up.dot(placed.nodes[node]) < height) any = std::max(any, up.dot(placed.nodes[node]));
    }
    for (const auto& piece : mesh::convex_pieces(placed, block)) {
      const std::optional<double> hit = upper_hit(piece, top, up);
      if (hit && *hit <= 0) under = std::max(under, height + *hit);
    }
  }
  if (under == -infinity) under = any;
  return height > -infinity && under > -infinity ? height - under : 0.0;
}

}  // namespace scree::rigid
