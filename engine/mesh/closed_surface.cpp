#include "engine/mesh/closed_surface.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/gmsh_session.h"
#include "engine/mesh/problems.h"
#include "engine/mesh/surface_refinement.h"

namespace scree::mesh {

namespace {

std::string place(const Eigen::Vector3d& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x(), p.y(), p.z());
}

// Those that have two corners at one place, as programs write them that round coordinates: the triangles beside them meet at
// what is left of them, an edge.
void drop_collapsed(RawMesh& raw) {
  std::erase_if(raw.triangles, [](const auto& cell) {
    const auto& [a, b, c] = cell.nodes;
    return a == b || b == c || c == a;
  });
}

// Those that lie along an edge are gone by now (surface_refinement.h).
void check_flat(const BodySpec& body, const ClosedSurface& surface) {
  for (const auto& [a, b, c] : surface.triangles) {
    if (!is_flat(surface.points[a], surface.points[b], surface.points[c])) continue;
    throw file_error(body, fmt::format("a triangle is flat, near {}", place(surface.points[a])),
                     "Repair the surface, for instance with Meshlab");
  }
}

// Connects the triangles at every edge, which must be two.
DisjointSets connect(const BodySpec& body, const RawMesh& raw) {
  struct Use {
    std::size_t low, high, triangle;
  };
  std::vector<Use> uses;
  for (std::size_t t = 0; t < raw.triangles.size(); ++t) {
    const auto& nodes = raw.triangles[t].nodes;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % 3]);
      uses.push_back({low, high, t});
    }
  }
  std::stable_sort(uses.begin(), uses.end(),
                   [](const Use& a, const Use& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  DisjointSets joined(raw.triangles.size());
  std::vector<Use> open, crowded;
  for (std::size_t i = 0, next = 0; i < uses.size(); i = next) {
    while (next < uses.size() && uses[next].low == uses[i].low && uses[next].high == uses[i].high) {
      joined.join(uses[next++].triangle, uses[i].triangle);
    }
    if (next == i + 1) open.push_back(uses[i]);
    if (next > i + 2) crowded.push_back(uses[i]);
  }
  const auto refuse = [&](const std::vector<Use>& wrong, const char* what) {
    throw file_error(body,
                     fmt::format("must be closed; {} of its edges {}, the first from {} to {}", wrong.size(), what,
                                 place(raw.points[wrong[0].low]), place(raw.points[wrong[0].high])),
                     "Repair the surface, for instance with Meshlab");
  };
  if (!open.empty()) refuse(open, "have a triangle on one side only");
  if (!crowded.empty()) refuse(crowded, "have more than two triangles");
  return joined;
}

ClosedSurface shell_of(const RawMesh& raw, const std::vector<std::size_t>& triangles) {
  ClosedSurface shell;
  std::vector<std::size_t> nodes;
  for (const std::size_t t : triangles) nodes.insert(nodes.end(), raw.triangles[t].nodes.begin(), raw.triangles[t].nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const std::size_t node : nodes) shell.points.push_back(raw.points[node]);
  for (const std::size_t t : triangles) {
    std::array<std::size_t, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] =
          static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), raw.triangles[t].nodes[i]) - nodes.begin());
    }
    shell.triangles.push_back(corners);
  }
  return shell;
}

// An upper bound of the elements that `mesh_size` makes: of the box around the shell.
double expected_elements(const ClosedSurface& shell, double mesh_size) {
  double area = 0;
  Eigen::AlignedBox3d box;
  for (const auto& [a, b, c] : shell.triangles) {
    area += (shell.points[b] - shell.points[a]).cross(shell.points[c] - shell.points[a]).norm() / 2;
    for (const std::size_t node : {a, b, c}) box.extend(shell.points[node]);
  }
  return std::max(triangles_in(area, mesh_size), tetrahedra_in(box.volume(), mesh_size));
}

SimplexMesh<3> fill(const BodySpec& body, const ClosedSurface& shell) {
  expect_reasonable(body, expected_elements(shell, body.mesh_size));
  const ClosedSurface surface = refined(shell, 1.4 * body.mesh_size);
  check_flat(body, surface);
  std::vector<std::size_t> tags(surface.points.size()), corners;
  std::iota(tags.begin(), tags.end(), std::size_t{1});
  std::vector<double> coordinates;
  for (const Eigen::Vector3d& point : surface.points) coordinates.insert(coordinates.end(), point.begin(), point.end());
  for (const auto& triangle : surface.triangles) {
    for (const std::size_t node : triangle) corners.push_back(node + 1);
  }
  RawMesh raw;
  with_gmsh([&] {
    gmsh::add_model(body.name);
    const int face = gmsh::add_discrete_surface();
    gmsh::add_nodes(face, tags, coordinates);
    gmsh::add_triangles(face, corners);
    gmsh::add_volume(gmsh::add_surface_loop({face}));
    gmsh::synchronize_geo();
    generate(3, body.mesh_size);
    raw = model_mesh();
  });
  if (raw.tetrahedra.empty()) throw GmshFailure{"no tetrahedra were made"};
  return whole_of<3>(raw);
}

bool holds(const SimplexMesh<3>& mesh, const Eigen::Vector3d& point) {
  return std::any_of(mesh.elements.begin(), mesh.elements.end(), [&](const auto& element) {
    std::array<Point<3>, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.nodes[element[i]];
    for (std::size_t i = 0; i < 4; ++i) {
      auto moved = corners;
      moved[i] = point;
      if (signed_volume<3>(moved) <= 0) return false;
    }
    return true;
  });
}

// Whether one of the first nodes of `inner` is inside `outer`; one alone might lie on a face between two elements.
bool reaches_into(const SimplexMesh<3>& inner, const SimplexMesh<3>& outer) {
  const std::size_t asked = std::min<std::size_t>(8, inner.nodes.size());
  return std::any_of(inner.nodes.begin(), inner.nodes.begin() + static_cast<std::ptrdiff_t>(asked),
                     [&](const Point<3>& node) { return holds(outer, node); });
}

void check_hollows(const BodySpec& body, const Parts<3>& parts) {
  const auto& shells = parts.meshes;
  std::vector<Eigen::AlignedBox3d> boxes(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    for (const Point<3>& node : shells[i].nodes) boxes[i].extend(node);
  }
  for (std::size_t outer = 0; outer < shells.size(); ++outer) {
    for (std::size_t inner = 0; inner < shells.size(); ++inner) {
      if (inner == outer || !boxes[outer].intersects(boxes[inner]) || !reaches_into(shells[inner], shells[outer])) continue;
      throw file_error(body, fmt::format("shell {} lies inside shell {}", inner + 1, outer + 1),
                       "Give a hollow body as a volume mesh (.msh or .vtu with tetrahedra)");
    }
  }
}

}  // namespace

Parts<3> fill_surface(const BodySpec& body, RawMesh raw) {
  drop_collapsed(raw);
  if (raw.triangles.empty()) {
    throw file_error(body, "all of its triangles are flat", "Repair the surface, for instance with Meshlab");
  }
  DisjointSets joined = connect(body, raw);
  Parts<3> parts;
  try {
    for (const auto& shell : joined.groups(raw.triangles, [](std::size_t t) { return t; })) {
      parts.meshes.push_back(fill(body, shell_of(raw, shell)));
    }
  } catch (const GmshFailure& failure) {
    throw file_error(body, fmt::format("Gmsh could not mesh its inside: {}", failure.reason),
                     "Check that the surface does not cut itself");
  }
  check_hollows(body, parts);
  return parts;
}

}  // namespace scree::mesh
