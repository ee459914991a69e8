#include "engine/mesh/volume_mesh.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "engine/mesh/conforming.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/problems.h"

namespace scree::mesh {

namespace {

template <int dim>
constexpr const char* simplex_name = dim == 2 ? "triangle" : "tetrahedron";

template <int dim>
const char* element_name(const RawMesh& raw) {
  return raw.cells.empty() ? simplex_name<dim> : "cell";
}

template <int dim>
std::array<Point<dim>, dim + 1> corners_of(const RawMesh& raw, const RawCell<dim + 1>& cell) {
  std::array<Point<dim>, dim + 1> corners;
  for (std::size_t i = 0; i <= dim; ++i) corners[i] = raw.points[cell.nodes[i]].template head<dim>();
  return corners;
}

template <int dim>
void check_elements(const BodySpec& body, const RawMesh& raw) {
  for (const auto& cell : element_cells<dim>(raw)) {
    const auto corners = corners_of<dim>(raw, cell);
    const double volume = signed_volume<dim>(corners);
    if (std::abs(volume) <= flat_volume<dim>(corners)) {
      throw file_error(body, fmt::format("{} {} is flat", element_name<dim>(raw), cell.number), "Mesh the shape again");
    }
    if (volume < 0) {
      throw file_error(
          body, fmt::format("{} {} is inside out", element_name<dim>(raw), cell.number),
          dim == 2 ? "Turn the surface over, so that its triangles run counter-clockwise" : "Mesh the shape again");
    }
  }
}

// Every face belongs to one element or to two, one on each side.
template <int dim>
void check_faces(const BodySpec& body, const RawMesh& raw) {
  const auto& cells = element_cells<dim>(raw);
  struct Side {
    std::array<std::size_t, dim> face;  // sorted
    bool front;
    std::size_t number;
  };
  std::vector<Side> sides;
  for (const auto& cell : cells) {
    for (std::size_t out = 0; out <= dim; ++out) {
      // The corner left out and the swaps that sort the others tell the side.
      Side side{{}, out % 2 == 0, cell.number};
      for (std::size_t i = 0, k = 0; i <= dim; ++i) {
        if (i != out) side.face[k++] = cell.nodes[i];
      }
      for (std::size_t i = 0; i < dim; ++i) {
        for (std::size_t j = i + 1; j < dim; ++j) side.front ^= side.face[i] > side.face[j];
      }
      std::sort(side.face.begin(), side.face.end());
      sides.push_back(side);
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return std::tie(a.face, a.front) < std::tie(b.face, b.front); });
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].face != sides[i - 1].face || sides[i].front != sides[i - 1].front) continue;
    throw file_error(body,
                     fmt::format("{0}s {1} and {2} lie on the same side of a face", element_name<dim>(raw), sides[i - 1].number,
                                 sides[i].number),
                     "Remove elements that are there twice or overlap");
  }
}

// Triangles beside tetrahedra are the faces an exporter adds; any other one would be lost.
void check_extra_triangles(const BodySpec& body, const RawMesh& raw) {
  std::vector<bool> used(raw.points.size(), false);
  for (const auto& cell : raw.tetrahedra) {
    for (const std::size_t node : cell.nodes) used[node] = true;
  }
  for (const auto& cell : raw.triangles) {
    if (std::all_of(cell.nodes.begin(), cell.nodes.end(), [&](std::size_t node) { return used[node]; })) continue;
    throw file_error(body, fmt::format("triangle {} belongs to no tetrahedron", cell.number),
                     "Mesh the volume behind it, or give it as a body of its own");
  }
}

}  // namespace

template <int dim>
Parts<dim> checked_volume(const BodySpec& body, const RawMesh& raw) {
  check_elements<dim>(body, raw);
  check_faces<dim>(body, raw);
  if (body.blocks != BlockRule::per_element) expect_conforming<dim>(body, raw);
  if constexpr (dim == 3) check_extra_triangles(body, raw);
  const auto& cells = element_cells<dim>(raw);
  DisjointSets joined(raw.points.size());
  for (const auto& cell : cells) {
    for (const std::size_t node : cell.nodes) joined.join(node, cell.nodes[0]);
  }
  Parts<dim> parts;
  parts.meshes = parts_of<dim>(raw, joined.groups(cells, [&](std::size_t e) { return cells[e].nodes[0]; }));
  for (const RawSurface& surface : raw.surfaces) parts.surfaces.push_back(surface.name);
  return parts;
}

template Parts<2> checked_volume<2>(const BodySpec&, const RawMesh&);
template Parts<3> checked_volume<3>(const BodySpec&, const RawMesh&);

}  // namespace scree::mesh
