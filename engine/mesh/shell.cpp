#include "engine/mesh/shell.h"

#include <algorithm>
#include <map>

#include "engine/mesh/tetrahedron_faces.h"

namespace scree::mesh {

namespace {

// False if an edge belongs to more or fewer than two triangles.
bool connect(Shell& shell) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> owner;
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    const auto& corner = shell.triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (!owner.emplace(std::pair{corner[i], corner[(i + 1) % 3]}, static_cast<std::int32_t>(t)).second) return false;
    }
  }
  for (const auto& corner : shell.triangles) {
    auto& beside = shell.neighbours.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto twin = owner.find({corner[(i + 1) % 3], corner[i]});
      if (twin == owner.end()) return false;
      beside[i] = twin->second;
    }
  }
  return true;
}

// Height of the neighbour's far corner above a triangle, over the longest edge of the neighbour.
double dent(const Shell& shell, std::size_t triangle, int side) {
  const auto& far = shell.triangles[shell.neighbours[triangle][side]];
  const Eigen::Vector3d& from = shell.points[shell.triangles[triangle][0]];
  double longest = 0;
  double height = 0;
  for (int i = 0; i < 3; ++i) {
    longest = std::max(longest, (shell.points[far[i]] - shell.points[far[(i + 1) % 3]]).norm());
    height = std::max(height, shell.normals[triangle].dot(shell.points[far[i]] - from));
  }
  return height / longest;
}

double longest_edge(const Shell& shell) {
  double longest = 0;
  for (const auto& corner : shell.triangles) {
    for (int i = 0; i < 3; ++i) {
      longest = std::max(longest, (shell.points[corner[i]] - shell.points[corner[(i + 1) % 3]]).norm());
    }
  }
  return longest;
}

// Whether no point lies above a triangle: small dents add up to a dish. Of large shells some triangles only are asked, evenly
// chosen: a dish that matters lies above many of them.
bool lies_below_its_triangles(const Shell& shell) {
  constexpr std::size_t most = 100'000'000;  // points asked in all, a tenth of a second
  const std::size_t stride = 1 + shell.triangles.size() * shell.points.size() / most;
  const double allowed = allowed_dent * longest_edge(shell);
  for (std::size_t t = 0; t < shell.triangles.size(); t += stride) {
    const Eigen::Vector3d& from = shell.points[shell.triangles[t][0]];
    for (const Eigen::Vector3d& point : shell.points) {
      if (shell.normals[t].dot(point - from) > allowed) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<Shell> shell_of(const BlockMesh<3>& mesh, BlockId block) {
  std::map<std::array<NodeId, 3>, int> uses;
  std::vector<std::array<NodeId, 3>> all;
  for (const ElementId e : mesh.blocks[block].elements) {
    for (const auto& face : faces_of_tetrahedron) {
      const auto& node = mesh.elements[e];
      all.push_back({node[face[0]], node[face[1]], node[face[2]]});
      ++uses[sorted(all.back())];
    }
  }
  Shell shell;
  std::map<NodeId, std::int32_t> number;
  for (const auto& face : all) {
    if (uses[sorted(face)] != 1) continue;
    auto& corners = shell.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto [at, fresh] = number.emplace(face[i], static_cast<std::int32_t>(shell.points.size()));
      if (fresh) shell.points.push_back(mesh.nodes[face[i]]);
      corners[i] = at->second;
    }
    const auto& p = shell.points;
    shell.normals.push_back((p[corners[1]] - p[corners[0]]).cross(p[corners[2]] - p[corners[0]]).normalized());
  }
  if (!connect(shell)) return std::nullopt;
  return shell;
}

bool is_convex(const Shell& shell) {
  std::vector<std::int32_t> part(shell.triangles.size(), -1);
  flood(shell, 0, 0, part, [](std::int32_t) { return true; });
  constexpr double rounding = 1e-9;
  double deepest = 0;
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    if (part[t] < 0) return false;
    for (int side = 0; side < 3; ++side) deepest = std::max(deepest, dent(shell, t, side));
    if (deepest > allowed_dent) return false;
  }
  return deepest <= rounding || lies_below_its_triangles(shell);
}

}  // namespace scree::mesh
