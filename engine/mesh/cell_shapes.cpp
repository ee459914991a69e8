#include "engine/mesh/cell_shapes.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/problems.h"
#include "engine/mesh/split_cells.h"

namespace scree::mesh {

namespace {

std::size_t steps(double length, double mesh_size) {
  return static_cast<std::size_t>(std::max(1.0, std::round(length / mesh_size)));
}

// Evenly from -length/2 to length/2, both to the bit: what follows the half length is -1 and 1 there.
double coordinate(double length, std::size_t step, std::size_t count) {
  return length / 2 * ((2 * static_cast<double>(step) - static_cast<double>(count)) / static_cast<double>(count));
}

// The base's cells as lists of corners, counter-clockwise: its quadrilaterals or, without any, its triangles.
std::vector<std::vector<std::size_t>> polygons(const SimplexMesh<2>& base) {
  std::vector<std::vector<std::size_t>> all;
  for (const RawLargeCell& cell : base.cells) all.emplace_back(cell.nodes.begin(), cell.nodes.begin() + 4);
  if (!all.empty()) return all;
  for (const auto& triangle : base.elements) all.emplace_back(triangle.begin(), triangle.end());
  return all;
}

}  // namespace

SimplexMesh<2> grid_of(const BodySpec& body, const Box& box) {
  const double along = std::max(1.0, box.size.x() / body.mesh_size), across = std::max(1.0, box.size.y() / body.mesh_size);
  expect_reasonable(body, 2 * along * across);
  const std::size_t columns = steps(box.size.x(), body.mesh_size), rows = steps(box.size.y(), body.mesh_size);
  RawMesh raw;
  for (std::size_t j = 0; j <= rows; ++j) {
    for (std::size_t i = 0; i <= columns; ++i) {
      raw.points.emplace_back(coordinate(box.size.x(), i, columns), coordinate(box.size.y(), j, rows), 0);
      if (i == columns || j == rows) continue;
      const std::size_t corner = j * (columns + 1) + i, above = corner + columns + 1;
      raw.cells.push_back({CellKind::quadrilateral, raw.cells.size(), {corner, corner + 1, above + 1, above}});
    }
  }
  split_cells<2>(body, raw);
  return whole_of<2>(raw);
}

SimplexMesh<3> extruded(const BodySpec& body, const SimplexMesh<2>& base, double height) {
  const auto bases = polygons(base);
  const std::size_t layers = steps(height, body.mesh_size);
  expect_reasonable(body, 6 * static_cast<double>(bases.size()) * static_cast<double>(layers));
  RawMesh raw;
  raw.points.reserve((layers + 1) * base.nodes.size());
  raw.cells.reserve(layers * bases.size());
  for (std::size_t layer = 0; layer <= layers; ++layer) {
    for (const Point<2>& node : base.nodes) raw.points.emplace_back(node.x(), node.y(), coordinate(height, layer, layers));
  }
  for (std::size_t layer = 0; layer < layers; ++layer) {
    for (const auto& polygon : bases) {
      const std::size_t corners = polygon.size();
      RawLargeCell cell{corners == 3 ? CellKind::wedge : CellKind::hexahedron, raw.cells.size(), {}};
      for (std::size_t i = 0; i < corners; ++i) {
        cell.nodes[i] = layer * base.nodes.size() + polygon[i];
        cell.nodes[corners + i] = cell.nodes[i] + base.nodes.size();
      }
      raw.cells.push_back(cell);
    }
  }
  split_cells<3>(body, raw);
  return whole_of<3>(raw);
}

template <int dim>
void check_cells(const BodySpec& body) {
  if (!body.cells) return;
  const char* kind = kind_name(*body.cells);
  if ((*body.cells == CellKind::quadrilateral) != (dim == 2)) {
    throw body_error(body, "elements", kind,
                     dim == 2 ? "must be simplex or quadrilateral in 2-D" : "must be simplex, wedge or hexahedron in 3-D", "");
  }
  if (dim == 3 && std::holds_alternative<Sphere>(body.shape)) {
    throw body_error(body, "elements", kind, "a sphere is made of simplices only",
                     "Leave it away, or give the sphere as a mesh file");
  }
}

template void check_cells<2>(const BodySpec&);
template void check_cells<3>(const BodySpec&);

}  // namespace scree::mesh
