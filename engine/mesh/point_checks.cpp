#include "engine/mesh/point_checks.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "engine/base/grouped.h"
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

struct Along {
  double way;  // [the file's unit]
  std::uint32_t point;

  friend auto operator<=>(const Along&, const Along&) = default;
};

// The points in their order along a direction in which those of a regular grid do not coincide. Put into slices first, of which
// there are as many as points: so it takes as long for each point of a large mesh as of a small one.
VectorWrittenLater<Along> in_order(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d direction = Eigen::Vector3d(0.5773, 0.6091, 0.5437).normalized();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector3d& point : points) {
    low = std::min(low, direction.dot(point));
    high = std::max(high, direction.dot(point));
  }
  const std::size_t last = points.size() - 1;
  const double slices = high > low ? static_cast<double>(last) / (high - low) : 0.0;
  auto sliced = grouped_by_number<Along>(points.size(), points.size(), [&](std::size_t p, const auto& visit) {
    const double way = direction.dot(points[p]);
    // In this order also of numbers so large that their difference is none.
    const double slice = std::min(static_cast<double>(last), (way - low) * slices);
    visit(static_cast<std::uint32_t>(slice), Along{way, static_cast<std::uint32_t>(p)});
  });
  for_chunks(points.size(), [&](Chunk chunk) {
    for (std::size_t slice = chunk.begin; slice < chunk.end; ++slice) {
      std::sort(sliced.of(slice).begin(), sliced.of(slice).end());
    }
  });
  return std::move(sliced.values);
}

void check_places(const BodySpec& body, const RawMesh& raw) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : raw.points) box.extend(point);
  const double tolerance = same_place * box.diagonal().norm();
  const auto order = in_order(raw.points);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && order[j].way - order[i].way <= tolerance; ++j) {
      if ((raw.points[order[i].point] - raw.points[order[j].point]).norm() > tolerance) continue;
      const auto [first, second] = std::minmax(raw.point_numbers[order[i].point], raw.point_numbers[order[j].point]);
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
