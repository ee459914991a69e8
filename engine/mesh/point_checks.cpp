#include "engine/mesh/point_checks.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "engine/mesh/problems.h"

namespace scree::mesh {

namespace {

// Of the mesh's extent; closer points are one place.
constexpr double same_place = 1e-9;

void check_numbers(const BodySpec& body, const RawMesh& raw) {
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    if (raw.points[i].allFinite()) continue;
    throw file_error(body, fmt::format("a coordinate of node {} is no number", raw.point_numbers[i]), "Export the mesh again");
  }
}

void check_use(const BodySpec& body, const RawMesh& raw) {
  std::vector<bool> used(raw.points.size(), false);
  for (const std::size_t node : raw.marked) used[node] = true;
  for (const auto& cell : raw.triangles) {
    for (const std::size_t node : cell.nodes) used[node] = true;
  }
  for (const auto& cell : raw.tetrahedra) {
    for (const std::size_t node : cell.nodes) used[node] = true;
  }
  for (const RawLargeCell& cell : raw.cells) {
    for (std::size_t i = 0; i < corner_count(cell.kind); ++i) used[cell.nodes[i]] = true;
  }
  const auto loose = std::find(used.begin(), used.end(), false);
  if (loose == used.end()) return;
  const auto first = static_cast<std::size_t>(loose - used.begin());
  throw file_error(body,
                   fmt::format("{} of its nodes belong to no element; the first is node {}",
                               std::count(loose, used.end(), false), raw.point_numbers[first]),
                   "Remove them, or export the elements they belong to");
}

void check_places(const BodySpec& body, const RawMesh& raw) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : raw.points) box.extend(point);
  const double tolerance = same_place * box.diagonal().norm();
  // Sorted along a direction in which the points of a regular grid do not coincide.
  const Eigen::Vector3d direction = Eigen::Vector3d(0.5773, 0.6091, 0.5437).normalized();
  std::vector<double> along(raw.points.size());
  std::transform(raw.points.begin(), raw.points.end(), along.begin(), [&](const auto& point) { return direction.dot(point); });
  std::vector<std::size_t> order(raw.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return along[a] < along[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && along[order[j]] - along[order[i]] <= tolerance; ++j) {
      if ((raw.points[order[i]] - raw.points[order[j]]).norm() > tolerance) continue;
      const auto [first, second] = std::minmax(raw.point_numbers[order[i]], raw.point_numbers[order[j]]);
      throw file_error(body, fmt::format("nodes {} and {} are at the same place", first, second),
                       "Merge such nodes (in Gmsh: Mesh, Remove duplicate nodes), or make touching parts bodies of their own");
    }
  }
}

}  // namespace

void check_points(const BodySpec& body, const RawMesh& raw) {
  check_numbers(body, raw);
  check_use(body, raw);
  check_places(body, raw);
}

}  // namespace scree::mesh
