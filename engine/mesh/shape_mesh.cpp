#include "engine/mesh/shape_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "engine/mesh/cell_shapes.h"
#include "engine/mesh/gmsh_session.h"
#include "engine/mesh/problems.h"
#include "engine/mesh/split_cells.h"

namespace scree::mesh {

namespace {

// Worst mean ratio of a mesh that needs no second attempt.
constexpr double good_quality = 0.4;

// Gmsh's faces are off by rounding; a block that lies on its face should not lean.
constexpr double snap = 1e-9;

double snapped(double value, double target) {
  return std::abs(std::abs(value) - target) < snap * target ? std::copysign(target, value) : value;
}

template <int dim>
void draw(const Box& box) {
  const Eigen::Vector3d low = -box.size / 2;
  if constexpr (dim == 2) {
    gmsh::add_rectangle(low.x(), low.y(), box.size.x(), box.size.y());
  } else {
    gmsh::add_box(low.x(), low.y(), low.z(), box.size.x(), box.size.y(), box.size.z());
  }
  gmsh::synchronize_occ();
}

// Eight octants rather than OpenCASCADE's sphere, whose seam and poles leave a coarse mesh almost flat.
void draw_octants(double radius) {
  const int centre = gmsh::add_point(0, 0, 0);
  int tip[3][2];
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector3d p = (side == 0 ? radius : -radius) * Eigen::Vector3d::Unit(axis);
      tip[axis][side] = gmsh::add_point(p.x(), p.y(), p.z());
    }
  }
  std::map<std::pair<int, int>, int> arcs;
  const auto arc = [&](int from, int to) {
    if (!arcs.contains({from, to})) {
      const int tag = gmsh::add_circle_arc(from, centre, to);
      arcs[{from, to}] = tag;
      arcs[{to, from}] = -tag;
    }
    return arcs[{from, to}];
  };
  std::vector<int> faces;
  for (int octant = 0; octant < 8; ++octant) {
    const int x = tip[0][octant & 1], y = tip[1][(octant >> 1) & 1], z = tip[2][octant >> 2];
    const bool mirrored = (((octant & 1) + ((octant >> 1) & 1) + (octant >> 2)) % 2) == 1;
    const int loop = mirrored ? gmsh::add_curve_loop({arc(x, z), arc(z, y), arc(y, x)})
                              : gmsh::add_curve_loop({arc(x, y), arc(y, z), arc(z, x)});
    faces.push_back(gmsh::add_surface_filling(loop, octant + 1, centre));
  }
  gmsh::add_volume(gmsh::add_surface_loop(faces));
  gmsh::synchronize_geo();
}

template <int dim>
void draw(const Sphere& sphere) {
  const double radius = sphere.diameter / 2;
  if constexpr (dim == 2) {
    gmsh::add_disc(radius);
    gmsh::synchronize_occ();
  } else {
    draw_octants(radius);
  }
}

template <int dim>
void draw(const Cylinder& cylinder) {
  gmsh::add_cylinder(-cylinder.height / 2, cylinder.height, cylinder.diameter / 2);
  gmsh::synchronize_occ();
}

void to_surface(const Box& box, Eigen::Vector3d& p) {
  for (int axis = 0; axis < 3; ++axis) p[axis] = snapped(p[axis], box.size[axis] / 2);
}
// Onto the circle or sphere around the first `axes` coordinates, if it is there but for rounding.
void to_radius(double radius, int axes, Eigen::Vector3d& p) {
  const double distance = p.head(axes).norm();
  if (std::abs(distance - radius) < 1e-6 * radius) p.head(axes) *= radius / distance;
}
void to_surface(const Sphere& sphere, Eigen::Vector3d& p) {
  to_radius(sphere.diameter / 2, 3, p);
}
void to_surface(const Cylinder& cylinder, Eigen::Vector3d& p) {
  p.z() = snapped(p.z(), cylinder.height / 2);
  to_radius(cylinder.diameter / 2, 2, p);
}

template <int dim>
double volume(const Box& box) {
  return dim == 2 ? box.size.x() * box.size.y() : box.size.prod();
}
template <int dim>
double volume(const Sphere& sphere) {
  const double radius = sphere.diameter / 2;
  return dim == 2 ? std::numbers::pi * radius * radius : 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}
template <int dim>
double volume(const Cylinder& cylinder) {
  return std::numbers::pi / 4 * cylinder.diameter * cylinder.diameter * cylinder.height;
}

// Of its outside [m2], in 2-D [m].
template <int dim>
double outside(const Box& box) {
  const Eigen::Vector3d& s = box.size;
  return dim == 2 ? 2 * (s.x() + s.y()) : 2 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
}
template <int dim>
double outside(const Sphere& sphere) {
  return std::numbers::pi * (dim == 2 ? sphere.diameter : sphere.diameter * sphere.diameter);
}
template <int dim>
double outside(const Cylinder& cylinder) {
  return std::numbers::pi * cylinder.diameter * (cylinder.height + cylinder.diameter / 2);
}

// What is thin has one for every two triangles, in 2-D edges, of its outside at least.
template <int dim, class ShapeType>
double expected_elements(const ShapeType& shape, double size) {
  if constexpr (dim == 2) return std::max(triangles_in(volume<2>(shape), size), outside<2>(shape) / size / 2);
  return std::max(tetrahedra_in(volume<3>(shape), size), triangles_in(outside<3>(shape), size) / 2);
}

struct Lengths {
  double least, largest;  // [m]
};

template <int dim>
Lengths lengths(const Box& box) {
  return {box.size.head<dim>().minCoeff(), box.size.head<dim>().maxCoeff()};
}
template <int dim>
Lengths lengths(const Sphere& sphere) {
  return {sphere.diameter, sphere.diameter};
}
template <int dim>
Lengths lengths(const Cylinder& cylinder) {
  return {std::min(cylinder.diameter, cylinder.height), std::max(cylinder.diameter, cylinder.height)};
}
template <int>
Lengths lengths(const MeshFile&) {
  return {};  // it is as the file says
}

// OpenCASCADE takes 1e-7 m for nothing, and may end the program: what comes near it is drawn in units of its own size [m].
template <int dim, class ShapeType>
double drawing_unit(const ShapeType& shape) {
  constexpr double small = 1e-6;
  const auto [least, largest] = lengths<dim>(shape);
  return least < small ? largest : 1;
}

Box in_units(const Box& box, double unit) {
  return {box.size / unit};
}
Sphere in_units(const Sphere& sphere, double unit) {
  return {sphere.diameter / unit};
}
Cylinder in_units(const Cylinder& cylinder, double unit) {
  return {cylinder.diameter / unit, cylinder.height / unit};
}

// Triangles or tetrahedra, or quadrilaterals if the body asks for them.
template <int dim, class ShapeType>
SimplexMesh<dim> mesh_drawn(const BodySpec& body, const ShapeType& shape) {
  expect_reasonable(body, expected_elements<dim>(shape, body.mesh_size));
  // Far beyond the shape, a size spoils the coarsest mesh instead of making it coarser.
  const double size = std::min(body.mesh_size, lengths<dim>(shape).largest);
  const double unit = drawing_unit<dim>(shape);
  // A thin plate's two sides come out alike from the frontal mesher, and nodes straight above each other make slivers, which
  // no optimiser can remove from between two faces. Then the next mesher is asked.
  SimplexMesh<dim> best;
  double best_quality = -1;
  for (const FaceMesher faces : {FaceMesher::frontal_delaunay, FaceMesher::delaunay, FaceMesher::mesh_adapt}) {
    RawMesh raw;
    with_gmsh([&] {
      gmsh::add_model(body.name);
      draw<dim>(in_units(shape, unit));
      if (body.cells) only_quadrilaterals();
      generate(dim, size / unit, faces);
      raw = model_mesh();
    });
    for (Eigen::Vector3d& point : raw.points) {
      point *= unit;
      to_surface(shape, point);
    }
    split_cells<dim>(body, raw);
    const SimplexMesh<dim> made = whole_of<dim>(raw);
    const double quality = worst_quality(made);
    if (quality > best_quality) best = made;
    best_quality = std::max(best_quality, quality);
    if (best_quality >= good_quality) break;
  }
  return best;
}

// Wedges and hexahedra stand on triangles and quadrilaterals.
SimplexMesh<3> mesh_extruded(const BodySpec& body, const Shape& plane, double height) {
  BodySpec base = body;
  base.shape = plane;
  base.cells.reset();
  if (body.cells == CellKind::hexahedron) base.cells = CellKind::quadrilateral;
  return extruded(body, mesh_shape<2>(base), height);
}

template <int dim, class ShapeType>
SimplexMesh<dim> mesh_in_cells(const BodySpec& body, const ShapeType& shape) {
  if constexpr (std::is_same_v<ShapeType, Box> && dim == 2) {
    return grid_of(body, shape);
  } else if constexpr (std::is_same_v<ShapeType, Box>) {
    return mesh_extruded(body, shape, shape.size.z());
  } else if constexpr (std::is_same_v<ShapeType, Cylinder>) {
    return mesh_extruded(body, Sphere{shape.diameter}, shape.height);
  } else {
    return mesh_drawn<dim>(body, shape);
  }
}

// Of shapes that are a thousand times as slender Gmsh ends the program, of rods that are some twenty times as slender.
template <int dim>
void check_slenderness(const BodySpec& body) {
  const auto* cylinder = std::get_if<Cylinder>(&body.shape);
  const double most = cylinder != nullptr && cylinder->height > cylinder->diameter ? 1e4 : 1e6;
  const auto [least, largest] = std::visit([](const auto& shape) { return lengths<dim>(shape); }, body.shape);
  if (largest > most * least) {
    throw body_error(body, "", fmt::format("{:g} m long and {:g} m thick", largest, least),
                     fmt::format("must be no more than {:g} times as long as thick", most), "Look at the units of its lengths");
  }
}

}  // namespace

template <int dim>
SimplexMesh<dim> mesh_shape(const BodySpec& body) {
  const auto mesh = [&](const auto& shape) -> SimplexMesh<dim> {
    using ShapeType = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<ShapeType, MeshFile>) {
      throw std::logic_error("mesh_shape: a mesh file is no shape");
    } else if constexpr (std::is_same_v<ShapeType, Cylinder> && dim == 2) {
      throw body_error(body, "cylinder", "", "a scene in 2-D has no cylinders", "Use a box or a disc (sphere)");
    } else {
      return body.cells ? mesh_in_cells<dim>(body, shape) : mesh_drawn<dim>(body, shape);
    }
  };
  check_cells<dim>(body);
  check_slenderness<dim>(body);
  try {
    return std::visit(mesh, body.shape);
  } catch (const GmshFailure& failure) {
    throw body_error(body, "", "", fmt::format("Gmsh could not mesh it: {}", failure.reason), "Try another mesh_size");
  }
}

double largest_length(const Shape& shape) {
  if (std::holds_alternative<MeshFile>(shape)) return std::numeric_limits<double>::infinity();
  return std::visit([](const auto& one) { return lengths<3>(one).largest; }, shape);
}

template SimplexMesh<2> mesh_shape<2>(const BodySpec&);
template SimplexMesh<3> mesh_shape<3>(const BodySpec&);

}  // namespace scree::mesh
