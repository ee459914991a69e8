#include "engine/mesh/simplex_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/LU>

#include "engine/mesh/outer_cell_faces.h"

namespace scree::mesh {

namespace {

constexpr auto not_there = static_cast<std::size_t>(-1);

std::vector<OuterFace<3>> outer_faces_of_cells(const SimplexMesh<3>& mesh) {
  std::vector<OuterFace<3>> outer;
  const auto index = [](std::size_t node) { return node; };
  for_each_outer_face(mesh.cells, mesh.nodes.size(), index, [&](std::size_t c, CornerList corners) {
    for (const auto& triangle : face_triangles(corners.size())) {
      OuterFace<3> face;
      for (std::size_t i = 0; i < 3; ++i) face[i] = mesh.cells[c].nodes[corners[triangle[i]]];
      std::sort(face.begin(), face.end());
      outer.push_back(face);
    }
  });
  std::sort(outer.begin(), outer.end());
  return outer;
}

// Calls `visit` with the faces of dim nodes that make up a face of a file: itself, or the triangles in a quadrilateral.
template <int dim, class Visit>
void simplex_faces(const std::vector<std::size_t>& face, const Visit& visit) {
  OuterFace<dim> nodes{};
  if (face.size() == nodes.size()) {
    std::copy(face.begin(), face.end(), nodes.begin());
    visit(nodes);
  } else if (dim == 3 && face.size() == 4) {
    for (const auto& triangle : face_triangles(4)) {
      std::transform(triangle.begin(), triangle.end(), nodes.begin(), [&](std::size_t corner) { return face[corner]; });
      visit(nodes);
    }
  }
}

// Where the nodes of a file are in its parts.
struct Places {
  std::vector<std::size_t> part, node;  // of each; `not_there` if no part has it

  // The face in its part's own numbers, if one part has all of it.
  template <std::size_t size>
  bool move(std::array<std::size_t, size>& face) const {
    const std::size_t its = part[face[0]];
    if (its == not_there) return false;
    for (std::size_t& at : face) {
      if (part[at] != its) return false;
      at = node[at];
    }
    return true;
  }
};

template <int dim>
Places place_nodes(const RawMesh& raw, const std::vector<std::vector<std::size_t>>& sets,
                   std::vector<SimplexMesh<dim>>& parts) {
  const auto& cells = element_cells<dim>(raw);
  Places places{std::vector<std::size_t>(raw.points.size(), not_there), std::vector<std::size_t>(raw.points.size(), not_there)};
  for (std::size_t p = 0; p < sets.size(); ++p) {
    for (const std::size_t e : sets[p]) {
      for (const std::size_t node : cells[e].nodes) places.part[node] = p;
    }
  }
  std::vector<std::size_t> counts(parts.size(), 0);
  for (const std::size_t part : places.part) {
    if (part != not_there) ++counts[part];
  }
  for (std::size_t p = 0; p < parts.size(); ++p) parts[p].nodes.reserve(counts[p]);
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    if (places.part[i] == not_there) continue;
    auto& nodes = parts[places.part[i]].nodes;
    places.node[i] = nodes.size();
    nodes.push_back(raw.points[i].template head<dim>());
  }
  return places;
}

// A face of a surface is an outer face of a part, or there is none of these nodes.
template <int dim>
void name_faces(const RawMesh& raw, const Places& places, std::vector<SimplexMesh<dim>>& parts) {
  std::vector<std::vector<OuterFace<dim>>> outer;
  for (const SimplexMesh<dim>& part : parts) outer.push_back(outer_faces(part));
  for (std::size_t surface = 0; surface < raw.surfaces.size(); ++surface) {
    for (const std::vector<std::size_t>& face : raw.surfaces[surface].faces) {
      simplex_faces<dim>(face, [&](OuterFace<dim> nodes) {
        const std::size_t part = places.part[nodes[0]];
        if (!places.move(nodes)) return;
        std::sort(nodes.begin(), nodes.end());
        if (std::binary_search(outer[part].begin(), outer[part].end(), nodes)) parts[part].named.push_back({nodes, surface});
      });
    }
  }
}

}  // namespace

template <>
const std::vector<RawCell<3>>& element_cells<2>(const RawMesh& raw) {
  return raw.triangles;
}
template <>
const std::vector<RawCell<4>>& element_cells<3>(const RawMesh& raw) {
  return raw.tetrahedra;
}

template <int dim>
double signed_volume(const std::array<Point<dim>, dim + 1>& corners) {
  Eigen::Matrix<double, dim, dim> edges;
  for (int i = 0; i < dim; ++i) edges.col(i) = corners[i + 1] - corners[0];
  return edges.determinant() / (dim == 2 ? 2.0 : 6.0);
}

template <int dim>
double flat_volume(const std::array<Point<dim>, dim + 1>& corners) {
  double longest = 0;  // squared
  for (std::size_t i = 0; i <= dim; ++i) {
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (corners[i] - corners[j]).squaredNorm());
  }
  return 1e-10 * (dim == 2 ? longest : longest * std::sqrt(longest));
}

template <int dim>
double worst_quality(const SimplexMesh<dim>& mesh) {
  double worst = 1;
  for (const auto& element : mesh.elements) {
    std::array<Point<dim>, dim + 1> corners;
    for (std::size_t i = 0; i <= dim; ++i) corners[i] = mesh.nodes[element[i]];
    double squares = 0;
    for (std::size_t i = 0; i <= dim; ++i) {
      for (std::size_t j = 0; j < i; ++j) squares += (corners[i] - corners[j]).squaredNorm();
    }
    const double volume = std::max(0.0, signed_volume<dim>(corners));
    worst = std::min(worst, dim == 2 ? 4 * std::sqrt(3.0) * volume / squares : 12 * std::cbrt(9 * volume * volume) / squares);
  }
  return worst;
}

template <int dim>
std::vector<OuterFace<dim>> outer_faces(const SimplexMesh<dim>& mesh) {
  if constexpr (dim == 3) {
    if (!mesh.cells.empty()) return outer_faces_of_cells(mesh);
  }
  const auto face_of = [&](std::size_t element, std::size_t out) {
    OuterFace<dim> face;
    for (std::size_t i = 0, k = 0; i <= dim; ++i) {
      if (i != out) face[k++] = mesh.elements[element][i];
    }
    std::sort(face.begin(), face.end());
    return face;
  };
  const auto nodes_of = [&](std::size_t e) {
    std::array<std::uint32_t, dim + 1> nodes;
    std::transform(mesh.elements[e].begin(), mesh.elements[e].end(), nodes.begin(),
                   [](std::size_t n) { return static_cast<std::uint32_t>(n); });
    return nodes;
  };
  std::vector<OuterFace<dim>> outer;
  for (const std::uint32_t place : lone_simplex_faces<dim>(mesh.nodes.size(), mesh.elements.size(), nodes_of)) {
    outer.push_back(face_of(place / (dim + 1), place % (dim + 1)));
  }
  std::sort(outer.begin(), outer.end());
  return outer;
}

template <int dim>
std::vector<SimplexMesh<dim>> parts_of(const RawMesh& raw, const std::vector<std::vector<std::size_t>>& sets) {
  const auto& cells = element_cells<dim>(raw);
  std::vector<SimplexMesh<dim>> parts(sets.size());
  const Places places = place_nodes<dim>(raw, sets, parts);
  for (std::size_t p = 0; p < sets.size(); ++p) {
    parts[p].elements.reserve(sets[p].size());
    for (const std::size_t e : sets[p]) {
      auto nodes = cells[e].nodes;
      for (std::size_t& node : nodes) node = places.node[node];
      parts[p].elements.push_back(nodes);
    }
  }
  for (RawLargeCell cell : raw.cells) {
    const std::size_t part = places.part[cell.nodes[0]];
    for (std::size_t i = 0; i < corner_count(cell.kind); ++i) cell.nodes[i] = places.node[cell.nodes[i]];
    parts[part].cells.push_back(cell);
  }
  if (!raw.surfaces.empty()) name_faces<dim>(raw, places, parts);
  return parts;
}

template <int dim>
SimplexMesh<dim> whole_of(const RawMesh& raw) {
  std::vector<std::size_t> all(element_cells<dim>(raw).size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return std::move(parts_of<dim>(raw, {all}).front());
}

template double signed_volume<2>(const std::array<Point<2>, 3>&);
template double signed_volume<3>(const std::array<Point<3>, 4>&);
template double flat_volume<2>(const std::array<Point<2>, 3>&);
template double flat_volume<3>(const std::array<Point<3>, 4>&);
template double worst_quality<2>(const SimplexMesh<2>&);
template double worst_quality<3>(const SimplexMesh<3>&);
template std::vector<OuterFace<2>> outer_faces<2>(const SimplexMesh<2>&);
template std::vector<OuterFace<3>> outer_faces<3>(const SimplexMesh<3>&);
template std::vector<SimplexMesh<2>> parts_of<2>(const RawMesh&, const std::vector<std::vector<std::size_t>>&);
template std::vector<SimplexMesh<3>> parts_of<3>(const RawMesh&, const std::vector<std::vector<std::size_t>>&);
template SimplexMesh<2> whole_of<2>(const RawMesh&);
template SimplexMesh<3> whole_of<3>(const RawMesh&);

}  // namespace scree::mesh
