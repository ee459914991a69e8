#include "engine/mesh/merged_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace scree::mesh {

namespace {

// What may be one face: triangles whose normals differ by at most this angle [rad] and whose corners lie in one plane, but for
// this part of the block's diagonal. The first does for blocks that were meshed here; corners that were rounded to the digits
// of a file want the second.
struct Flatness {
  double angle;
  double height;
};
constexpr Flatness exactly_flat{1e-6, 1};
constexpr Flatness nearly_flat{0.05, 1e-4};
constexpr double bent_by = 5e-3;  // faces at a smaller angle are nearly one [rad]

// Triangles in groups, each to be one face.
struct Groups {
  std::vector<std::int32_t> of;  // each triangle
  std::vector<Eigen::Vector3d> normals;
};

Groups single_triangles(const Shell& shell) {
  Groups groups{std::vector<std::int32_t>(shell.triangles.size()), shell.normals};
  std::iota(groups.of.begin(), groups.of.end(), 0);
  return groups;
}

double area(const Shell& shell, std::size_t triangle) {
  const auto& c = shell.triangles[triangle];
  return (shell.points[c[1]] - shell.points[c[0]]).cross(shell.points[c[2]] - shell.points[c[0]]).norm() / 2;
}

// Around the seeds in their order.
Groups grown(const Shell& shell, const std::vector<std::size_t>& seeds, const Flatness& flat) {
  Aabb<3> box;
  for (const Eigen::Vector3d& point : shell.points) box.extend(point);
  const double height = flat.height * box.diagonal().norm();
  Groups groups{std::vector<std::int32_t>(shell.triangles.size(), -1), {}};
  for (const std::size_t seed : seeds) {
    if (groups.of[seed] >= 0) continue;
    const Eigen::Vector3d& normal = shell.normals[seed];
    const Eigen::Vector3d& on = shell.points[shell.triangles[seed][0]];
    flood(shell, static_cast<std::int32_t>(seed), static_cast<std::int32_t>(groups.normals.size()), groups.of,
          [&](std::int32_t n) {
            const Eigen::Vector3d& other = shell.normals[n];
            const auto& corners = shell.triangles[n];
            return normal.cross(other).norm() < flat.angle && normal.dot(other) > 0 &&
                   std::all_of(corners.begin(), corners.end(),
                               [&](std::int32_t c) { return std::abs(normal.dot(shell.points[c] - on)) <= height; });
          });
    groups.normals.push_back(normal);
  }
  return groups;
}

// Large triangles first, whose normals are rounded least; each face with the mean of its triangles' normals.
Groups grown_from_the_largest(const Shell& shell) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) areas.push_back(area(shell, t));
  std::vector<std::size_t> seeds(areas.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  Groups groups = grown(shell, seeds, nearly_flat);
  for (Eigen::Vector3d& normal : groups.normals) normal.setZero();
  for (std::size_t t = 0; t < areas.size(); ++t) groups.normals[groups.of[t]] += areas[t] * shell.normals[t];
  for (Eigen::Vector3d& normal : groups.normals) normal.normalize();
  return groups;
}

// The corners that each group is bounded by, one after the other; nothing if one is not bounded by a single line.
using Outline = std::vector<std::int32_t>;
std::optional<std::vector<Outline>> outlines(const Shell& shell, const Groups& groups) {
  std::vector<std::map<std::int32_t, std::int32_t>> next(groups.normals.size());
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (groups.of[shell.neighbours[t][i]] == groups.of[t]) continue;
      const auto& corners = shell.triangles[t];
      if (!next[groups.of[t]].emplace(corners[i], corners[(i + 1) % 3]).second) return std::nullopt;
    }
  }
  std::vector<Outline> result;
  for (const auto& edges : next) {
    if (edges.empty()) return std::nullopt;
    Outline& outline = result.emplace_back(Outline{edges.begin()->first});
    for (std::int32_t at = edges.begin()->second; at != outline.front() && outline.size() < edges.size(); at = edges.at(at)) {
      outline.push_back(at);
    }
    if (outline.size() != edges.size() || edges.at(outline.back()) != outline.front()) return std::nullopt;
  }
  return result;
}

bool is_convex(const ConvexPiece& piece, const ConvexPiece::Face& face) {
  const std::size_t count = face.corners.size();
  const auto side = [&](std::size_t i) -> Eigen::Vector3d {
    return (piece.vertices[face.corners[(i + 1) % count]] - piece.vertices[face.corners[i % count]]).normalized();
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (side(i).cross(side(i + 1)).dot(face.normal) < -allowed_dent) return false;
  }
  return count >= 3;
}

// The edges that stand out: dents part nothing.
void add_ridges(ConvexPiece& piece) {
  add_edges(piece);
  std::erase_if(piece.edges, [&](const ConvexPiece::Edge& edge) {
    const auto& [left, right] = edge.faces;
    const Eigen::Vector3d along = piece.vertices[edge.corners[1]] - piece.vertices[edge.corners[0]];
    const Eigen::Vector3d turn = piece.faces[left].normal.cross(piece.faces[right].normal);
    if (turn.norm() < bent_by) piece.faces[left].bent = piece.faces[right].bent = true;
    return turn.dot(along) <= 0;
  });
}

// Keeps the points at which three or more faces meet: the others lie inside a face or on a straight edge. Nothing if a face
// would not be a convex polygon.
std::optional<ConvexPiece> merged(const Shell& shell, const Groups& groups) {
  const auto bounds = outlines(shell, groups);
  if (!bounds) return std::nullopt;
  std::vector<std::set<std::int32_t>> faces_at(shell.points.size());
  for (std::size_t t = 0; t < groups.of.size(); ++t) {
    for (const std::int32_t corner : shell.triangles[t]) faces_at[corner].insert(groups.of[t]);
  }
  ConvexPiece piece;
  std::vector<std::int32_t> number(shell.points.size(), -1);
  for (std::size_t p = 0; p < shell.points.size(); ++p) {
    if (faces_at[p].size() < 3) continue;
    number[p] = static_cast<std::int32_t>(piece.vertices.size());
    piece.vertices.push_back(shell.points[p]);
  }
  for (const Outline& outline : *bounds) {
    auto& face = piece.faces.emplace_back(ConvexPiece::Face{groups.normals[piece.faces.size()], {}});
    for (const std::int32_t corner : outline) {
      if (number[corner] >= 0) face.corners.push_back(number[corner]);
    }
    if (!is_convex(piece, face)) return std::nullopt;
  }
  add_ridges(piece);
  return piece;
}

}  // namespace

void add_edges(ConvexPiece& piece) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> owner;
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const auto& corners = piece.faces[f].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      owner[{corners[i], corners[(i + 1) % corners.size()]}] = static_cast<std::int32_t>(f);
    }
  }
  for (const auto& [edge, face] : owner) {
    const auto twin = owner.find({edge.second, edge.first});
    if (edge.first < edge.second && twin != owner.end())
      piece.edges.push_back({{edge.first, edge.second}, {face, twin->second}, false, {}});
  }
}

ConvexPiece merged_faces(const Shell& shell) {
  std::vector<std::size_t> in_order(shell.triangles.size());
  std::iota(in_order.begin(), in_order.end(), 0);
  const auto exact = merged(shell, grown(shell, in_order, exactly_flat));
  const auto is_bent = [](const ConvexPiece::Face& face) { return face.bent; };
  if (exact && std::none_of(exact->faces.begin(), exact->faces.end(), is_bent)) return *exact;
  if (const auto nearly = merged(shell, grown_from_the_largest(shell))) return *nearly;
  return exact ? *exact : *merged(shell, single_triangles(shell));
}

}  // namespace scree::mesh
