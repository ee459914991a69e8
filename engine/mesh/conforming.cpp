#include "engine/mesh/conforming.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "engine/base/geometry.h"
#include "engine/mesh/lone_faces.h"
#include "engine/mesh/outer_cell_faces.h"
#include "engine/mesh/problems.h"
#include "engine/mesh/simplex_mesh.h"

namespace scree::mesh {

namespace {

// Two faces closer to each other than this lie on each other [rad]: above the rounding of coordinates in single precision,
// below the angle of any notch that a mesher leaves.
constexpr double least_angle = 1e-3;

// A face of one element only, at one of its corners.
template <int dim>
struct Corner {
  std::size_t element;
  std::array<Point<dim>, dim - 1> sides;  // unit vectors along its edges
  Point<dim> normal;                      // unit, of either sign; not in 2-D
};

template <int dim>
double angle(const Point<dim>& a, const Point<dim>& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());  // Kahan's, exact for small angles, too
}

// Whether the two, corners at one node, have more in common than an edge.
bool overlap(const Corner<2>& a, const Corner<2>& b) {
  return angle<2>(a.sides[0], b.sides[0]) < least_angle;
}

bool overlap(const Corner<3>& a, const Corner<3>& b) {
  // Nearly all pairs lean by more than twice that angle.
  if (std::abs(a.normal.dot(b.normal)) < 1 - 2 * least_angle * least_angle) return false;
  if (std::min(angle<3>(a.normal, b.normal), angle<3>(a.normal, -b.normal)) > least_angle) return false;
  const auto middle = [](const Corner<3>& corner) { return (corner.sides[0] + corner.sides[1]).normalized(); };
  const double reach = (angle<3>(a.sides[0], a.sides[1]) + angle<3>(b.sides[0], b.sides[1])) / 2;
  return angle<3>(middle(a), middle(b)) < reach - least_angle;
}

// A face that belongs to one element only.
struct LoneFace {
  std::size_t element;  // its number
  std::uint32_t count;  // of its nodes, which go round
  std::array<std::uint32_t, 4> nodes;
};

template <int dim>
std::vector<LoneFace> lone_faces_of(const RawMesh& raw) {
  std::vector<LoneFace> lone;
  if (dim == 3 && !raw.cells.empty()) {
    for_each_outer_face(
        raw.cells, raw.points.size(), [](std::size_t node) { return node; },
        [&](std::size_t cell, CornerList corners) {
          LoneFace& face = lone.emplace_back(LoneFace{raw.cells[cell].number, static_cast<std::uint32_t>(corners.size()), {}});
          std::transform(corners.begin(), corners.end(), face.nodes.begin(),
                         [&](std::size_t i) { return static_cast<std::uint32_t>(raw.cells[cell].nodes[i]); });
        });
    return lone;
  }
  const auto& elements = element_cells<dim>(raw);
  const auto face_of = [&](std::size_t element, std::size_t out) {
    std::array<std::uint32_t, dim> face;
    for (std::size_t i = 0, k = 0; i <= dim; ++i) {
      if (i != out) face[k++] = static_cast<std::uint32_t>(elements[element].nodes[i]);
    }
    return face;
  };
  const auto nodes_of = [&](std::size_t element) {
    std::array<std::uint32_t, dim + 1> nodes;
    for (std::size_t i = 0; i <= dim; ++i) nodes[i] = static_cast<std::uint32_t>(elements[element].nodes[i]);
    return nodes;
  };
  for (const std::uint32_t place : lone_simplex_faces<dim>(raw.points.size(), elements.size(), nodes_of)) {
    const auto nodes = face_of(place / (dim + 1), place % (dim + 1));
    LoneFace& face = lone.emplace_back(LoneFace{elements[place / (dim + 1)].number, dim, {}});
    std::copy(nodes.begin(), nodes.end(), face.nodes.begin());
  }
  return lone;
}

// The faces at each node, those at one node beside each other, in ascending order.
struct FacesAtNodes {
  std::vector<std::uint32_t> ends, faces;
};

FacesAtNodes by_node(const std::vector<LoneFace>& faces, std::size_t nodes) {
  FacesAtNodes at{std::vector<std::uint32_t>(nodes + 1, 0), {}};
  const auto for_each_corner = [&](const auto& use) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      for (std::uint32_t i = 0; i < faces[f].count; ++i) use(f, faces[f].nodes[i]);
    }
  };
  for_each_corner([&](std::uint32_t, std::uint32_t node) { ++at.ends[node + 1]; });
  std::partial_sum(at.ends.begin(), at.ends.end(), at.ends.begin());
  at.faces.resize(at.ends.back());
  for_each_corner([&](std::uint32_t face, std::uint32_t node) { at.faces[at.ends[node]++] = face; });
  return at;
}

template <int dim>
Corner<dim> corner_of(const RawMesh& raw, const LoneFace& face, std::uint32_t node) {
  const auto place = static_cast<std::uint32_t>(std::find(face.nodes.begin(), face.nodes.end(), node) - face.nodes.begin());
  const auto point = [&](std::uint32_t i) -> Point<dim> { return raw.points[face.nodes[i % face.count]].template head<dim>(); };
  Corner<dim> corner{face.element, {}, {}};
  corner.sides[0] = (point(place + 1) - point(place)).normalized();
  if constexpr (dim == 3) {
    corner.sides[1] = (point(place + face.count - 1) - point(place)).normalized();
    corner.normal = corner.sides[0].cross(corner.sides[1]).normalized();
  }
  return corner;
}

}  // namespace

template <int dim>
void expect_conforming(const BodySpec& body, const RawMesh& raw) {
  const std::vector<LoneFace> faces = lone_faces_of<dim>(raw);
  const FacesAtNodes at = by_node(faces, raw.points.size());
  std::vector<Corner<dim>> corners;
  for (std::uint32_t node = 0, begin = 0; node < raw.points.size(); begin = at.ends[node++]) {
    const std::span here = std::span(at.faces).subspan(begin, at.ends[node] - begin);
    const auto of_the_first = [&](std::uint32_t face) { return faces[face].element == faces[here.front()].element; };
    if (std::all_of(here.begin(), here.end(), of_the_first)) continue;
    corners.clear();
    for (const std::uint32_t face : here) corners.push_back(corner_of<dim>(raw, faces[face], node));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (corners[i].element == corners[j].element || !overlap(corners[i], corners[j])) continue;
        const Eigen::Vector3d& p = raw.points[node];
        throw file_error(body,
                         fmt::format("elements {} and {} lie on each other near ({:.6g}, {:.6g}, {:.6g}) m, but share no face",
                                     corners[j].element, corners[i].element, p.x(), p.y(), p.z()),
                         "Mesh both sides of that face alike, or make two bodies of them, with a joint between them");
      }
    }
  }
}

template void expect_conforming<2>(const BodySpec&, const RawMesh&);
template void expect_conforming<3>(const BodySpec&, const RawMesh&);

}  // namespace scree::mesh
