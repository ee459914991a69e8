#include "engine/mesh/conforming.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

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
  std::uint32_t node;
  std::uint32_t face;  // as they are visited
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

// Calls `visit` with the number of the element and the nodes of each face that no other element has, these going round.
template <int dim, class Visit>
void for_each_lone_face(const RawMesh& raw, const Visit& visit) {
  if (dim == 3 && !raw.cells.empty()) {
    std::vector<std::size_t> nodes;
    for_each_outer_face(
        raw.cells, raw.points.size(), [](std::size_t node) { return node; },
        [&](std::size_t cell, CornerList corners) {
          nodes.resize(corners.size());
          std::transform(corners.begin(), corners.end(), nodes.begin(),
                         [&](std::size_t i) { return raw.cells[cell].nodes[i]; });
          visit(raw.cells[cell].number, nodes);
        });
    return;
  }
  const auto& elements = element_cells<dim>(raw);
  const auto face_of = [&](std::size_t element, std::size_t out) {
    std::vector<std::size_t> nodes(elements[element].nodes.begin(), elements[element].nodes.end());
    nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(out));
    return nodes;
  };
  const auto for_each_face = [&](const auto& take) {
    for (const auto& element : elements) {
      for (std::size_t out = 0; out <= dim; ++out) {
        std::array<std::uint32_t, dim> face;
        for (std::size_t i = 0, k = 0; i <= dim; ++i) {
          if (i != out) face[k++] = static_cast<std::uint32_t>(element.nodes[i]);
        }
        std::sort(face.begin(), face.end());
        take(face);
      }
    }
  };
  for (const std::uint32_t place : lone_faces<dim>(raw.points.size(), for_each_face)) {
    visit(elements[place / (dim + 1)].number, face_of(place / (dim + 1), place % (dim + 1)));
  }
}

// All corners of all faces that belong to one element only.
template <int dim>
std::vector<Corner<dim>> lone_corners(const RawMesh& raw) {
  std::vector<Corner<dim>> corners;
  std::uint32_t face = 0;
  for_each_lone_face<dim>(raw, [&](std::size_t element, const std::vector<std::size_t>& nodes) {
    const auto point = [&](std::size_t i) -> Point<dim> { return raw.points[nodes[i % nodes.size()]].template head<dim>(); };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      Corner<dim> corner{static_cast<std::uint32_t>(nodes[i]), face, element, {}, {}};
      corner.sides[0] = (point(i + 1) - point(i)).normalized();
      if constexpr (dim == 3) {
        corner.sides[1] = (point(i + nodes.size() - 1) - point(i)).normalized();
        corner.normal = corner.sides[0].cross(corner.sides[1]).normalized();
      }
      corners.push_back(corner);
    }
    ++face;
  });
  return corners;
}

// The numbers of the corners, those at one node beside each other, in ascending order.
template <int dim>
std::vector<std::uint32_t> by_node(const std::vector<Corner<dim>>& corners, std::size_t nodes) {
  std::vector<std::uint32_t> next(nodes + 1, 0), order(corners.size());
  for (const Corner<dim>& corner : corners) ++next[corner.node + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::uint32_t i = 0; i < corners.size(); ++i) order[next[corners[i].node]++] = i;
  return order;
}

}  // namespace

template <int dim>
void expect_conforming(const BodySpec& body, const RawMesh& raw) {
  const std::vector<Corner<dim>> corners = lone_corners<dim>(raw);
  const std::vector<std::uint32_t> order = by_node<dim>(corners, raw.points.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && corners[order[end]].node == corners[order[begin]].node) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      const Corner<dim>& corner = corners[order[i]];
      for (std::size_t j = begin; j < i; ++j) {
        const Corner<dim>& other = corners[order[j]];
        if (corner.element == other.element || !overlap(corner, other)) continue;
        const Eigen::Vector3d& p = raw.points[corner.node];
        throw file_error(body,
                         fmt::format("elements {} and {} lie on each other near ({:.6g}, {:.6g}, {:.6g}) m, but share no face",
                                     other.element, corner.element, p.x(), p.y(), p.z()),
                         "Mesh both sides of that face alike, or make two bodies of them, with a joint between them");
      }
    }
  }
}

template void expect_conforming<2>(const BodySpec&, const RawMesh&);
template void expect_conforming<3>(const BodySpec&, const RawMesh&);

}  // namespace scree::mesh
