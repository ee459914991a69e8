#include "engine/mesh/split_cells.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/mesh/problems.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

namespace {

template <int dim>
std::vector<RawCell<dim + 1>>& simplices_of(RawMesh& raw) {
  if constexpr (dim == 2) {
    return raw.triangles;
  } else {
    return raw.tetrahedra;
  }
}

template <int dim, class Nodes>
std::array<Point<dim>, dim + 1> corners_of(const RawMesh& raw, const Nodes& nodes) {
  std::array<Point<dim>, dim + 1> corners;
  std::transform(nodes.begin(), nodes.end(), corners.begin(),
                 [&](std::size_t n) { return raw.points[n].template head<dim>(); });
  return corners;
}

template <int dim>
bool is_full(const std::array<Point<dim>, dim + 1>& corners) {
  return signed_volume<dim>(corners) > flat_volume<dim>(corners);
}

// Whether all simplices of all its splits are.
template <int dim>
bool is_full(const RawMesh& raw, const RawLargeCell& cell) {
  for (const CornerList& corners : mixed_simplices(cell.kind)) {
    std::array<std::size_t, dim + 1> nodes;
    std::transform(corners.begin(), corners.end(), nodes.begin(), [&](std::size_t corner) { return cell.nodes[corner]; });
    if (!is_full<dim>(corners_of<dim>(raw, nodes))) return false;
  }
  for (const auto& nodes : split_by_smallest<dim>(cell.kind, cell.nodes)) {
    if (!is_full<dim>(corners_of<dim>(raw, nodes))) return false;
  }
  return true;
}

template <int dim>
void orient(const BodySpec& body, const RawMesh& raw, RawLargeCell& cell) {
  if (is_full<dim>(raw, cell)) return;
  if (cell.kind == CellKind::wedge) {
    std::swap(cell.nodes[1], cell.nodes[2]);
    std::swap(cell.nodes[4], cell.nodes[5]);
    if (is_full<dim>(raw, cell)) return;
  }
  throw body_error(body, std::holds_alternative<MeshFile>(body.shape) ? "mesh.file" : "",
                   std::holds_alternative<MeshFile>(body.shape) ? std::get<MeshFile>(body.shape).path.string() : "",
                   fmt::format("{} {} is inside out, flat or not convex", kind_name(cell.kind), cell.number),
                   "Mesh the shape again");
}

// Quadrilaterals beside cells in 3-D are the faces an exporter adds.
void drop_faces(const BodySpec& body, RawMesh& raw) {
  std::vector<bool> used(raw.points.size(), false);
  for (const RawLargeCell& cell : raw.cells) {
    if (cell.kind == CellKind::quadrilateral) continue;
    for (std::size_t i = 0; i < corner_count(cell.kind); ++i) used[cell.nodes[i]] = true;
  }
  for (const RawLargeCell& cell : raw.cells) {
    if (cell.kind != CellKind::quadrilateral) continue;
    if (std::all_of(cell.nodes.begin(), cell.nodes.begin() + 4, [&](std::size_t node) { return used[node]; })) continue;
    throw file_error(body, fmt::format("quadrilateral {} belongs to no wedge or hexahedron", cell.number),
                     "Mesh the volume behind it, or cut a closed surface into triangles");
  }
  std::erase_if(raw.cells, [](const RawLargeCell& cell) { return cell.kind == CellKind::quadrilateral; });
}

}  // namespace

template <int dim>
void split_cells(const BodySpec& body, RawMesh& raw) {
  if (raw.cells.empty()) return;
  if constexpr (dim == 3) drop_faces(body, raw);
  const auto solid = std::find_if(raw.cells.begin(), raw.cells.end(), [](const RawLargeCell& cell) {
    return (cell.kind == CellKind::quadrilateral) != (dim == 2);
  });
  if (solid != raw.cells.end()) {
    throw file_error(body, fmt::format("a scene in 2-D has no {}", kind_name(solid->kind)), "Use `dimension: 3`");
  }
  if (!simplices_of<dim>(raw).empty()) {
    throw file_error(body,
                     fmt::format("it holds {} beside {}", kind_name(raw.cells[0].kind), dim == 2 ? "triangles" : "tetrahedra"),
                     "Mesh it with one family of elements, or make two bodies of it");
  }
  simplices_of<dim>(raw).reserve(raw.cells.size() * split_count(raw.cells[0].kind));
  for (RawLargeCell& cell : raw.cells) {
    orient<dim>(body, raw, cell);
    for (const auto& nodes : split_by_smallest<dim>(cell.kind, cell.nodes))
      simplices_of<dim>(raw).push_back({cell.number, nodes});
  }
}

template void split_cells<2>(const BodySpec&, RawMesh&);
template void split_cells<3>(const BodySpec&, RawMesh&);

}  // namespace scree::mesh
