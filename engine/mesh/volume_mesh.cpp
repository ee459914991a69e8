#include "engine/mesh/volume_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "engine/base/grouped.h"
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

// A face of an element, by its nodes but the least in ascending order, and on which side of it the element lies.
template <int dim>
struct Side {
  std::array<std::uint32_t, dim - 1> others;
  bool front;
  std::uint32_t element;

  [[nodiscard]] bool same_as(const Side& side) const { return others == side.others && front == side.front; }
  friend auto operator<=>(const Side&, const Side&) = default;
};

// Calls visit(least node, side) for every face of an element.
template <int dim, class Visit>
void sides_of(const RawCell<dim + 1>& cell, std::size_t element, const Visit& visit) {
  for (std::size_t out = 0; out <= dim; ++out) {
    std::array<std::uint32_t, dim> face;
    for (std::size_t i = 0, k = 0; i <= dim; ++i) {
      if (i != out) face[k++] = static_cast<std::uint32_t>(cell.nodes[i]);
    }
    // The corner left out and the swaps that sort the others tell the side.
    bool front = out % 2 == 0;
    for (std::size_t i = 0; i < dim; ++i) {
      for (std::size_t j = i + 1; j < dim; ++j) front ^= face[i] > face[j];
    }
    std::sort(face.begin(), face.end());
    Side<dim> side{{}, front, static_cast<std::uint32_t>(element)};
    std::copy(face.begin() + 1, face.end(), side.others.begin());
    visit(face[0], side);
  }
}

// Every face belongs to one element or to two, one on each side.
template <int dim>
void check_faces(const BodySpec& body, const RawMesh& raw) {
  const auto& cells = element_cells<dim>(raw);
  auto sides = grouped_by_number<Side<dim>>(cells.size(), raw.points.size(),
                                            [&](std::size_t e, const auto& visit) { sides_of<dim>(cells[e], e, visit); });
  for (std::size_t node = 0; node < raw.points.size(); ++node) {
    const auto here = sides.of(node);
    std::sort(here.begin(), here.end());
    const auto same = std::adjacent_find(here.begin(), here.end(), [](const auto& a, const auto& b) { return a.same_as(b); });
    if (same == here.end()) continue;
    throw file_error(body,
                     fmt::format("{0}s {1} and {2} lie on the same side of a face", element_name<dim>(raw),
                                 cells[same->element].number, cells[(same + 1)->element].number),
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
