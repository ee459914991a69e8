// Small meshes, materials and contacts for the tests of heat.
#pragma once

#include <cmath>
#include <map>

#include "thermal/heat_model.h"

namespace scree::thermal::test {

// kappa = 2e-6 m2/s: a metre takes days, a centimetre a minute.
inline Material rock() {
  Material material;
  material.name = "rock";
  material.density = 2500;
  material.conductivity = 4.0;
  material.specific_heat = 800;
  return material;
}

inline Table<MaterialId, Material> rock_only() {
  return Table<MaterialId, Material>({rock()});
}

// An axis-aligned box of cells, each cut into 2 triangles or 6 tetrahedra that fit their neighbours'.
template <int dim>
struct Slab {
  Point<dim> low = Point<dim>::Zero();
  Point<dim> size = Point<dim>::Ones();  // [m]
  std::array<int, dim> cells{};
  bool block_per_element = false;
  MaterialId material{0};
};

namespace detail {

template <int dim>
std::vector<std::array<int, dim>> cell_orders() {
  if constexpr (dim == 2) {
    return {{0, 1}, {1, 0}};
  } else {
    return {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  }
}

// The simplices of one cell as corner offsets: a walk along the axes in every order (Kuhn's division).
template <int dim>
std::vector<std::array<std::array<int, dim>, dim + 1>> cell_simplices() {
  std::vector<std::array<std::array<int, dim>, dim + 1>> simplices;
  for (const auto& order : cell_orders<dim>()) {
    std::array<std::array<int, dim>, dim + 1> corners{};
    for (int i = 0; i < dim; ++i) {
      corners[i + 1] = corners[i];
      ++corners[i + 1][order[i]];
    }
    simplices.push_back(corners);
  }
  return simplices;
}

}  // namespace detail

template <int dim>
void add_slab(mesh::BlockMesh<dim>& mesh, const Slab<dim>& slab) {
  const BodyId body = mesh.bodies.push_back({"body" + std::to_string(mesh.bodies.size()), slab.material, false, {}});
  std::map<std::array<int, dim>, NodeId> nodes;
  std::size_t first_node = mesh.nodes.size();
  const std::size_t first_element = mesh.elements.size();
  const auto node_at = [&](const std::array<int, dim>& index) {
    const auto [at, is_new] = nodes.try_emplace(index, NodeId{mesh.nodes.size()});
    if (is_new) {
      Point<dim> point;
      for (int i = 0; i < dim; ++i) point[i] = slab.low[i] + slab.size[i] * index[i] / slab.cells[i];
      mesh.nodes.push_back(point);
    }
    return at->second;
  };
  const auto add_cell = [&](const std::array<int, dim>& cell) {
    for (const auto& simplex : detail::cell_simplices<dim>()) {
      typename mesh::BlockMesh<dim>::Element element;
      for (int c = 0; c <= dim; ++c) {
        std::array<int, dim> index = cell;
        for (int i = 0; i < dim; ++i) index[i] += simplex[c][i];
        element[c] = node_at(index);
      }
      const ElementId id = mesh.elements.push_back(element);
      if (mesh::element_volume(mesh, id) < 0) std::swap(mesh.elements[id][dim - 1], mesh.elements[id][dim]);
      if (!slab.block_per_element) continue;
      nodes.clear();
      mesh.blocks.push_back({body, {first_node, mesh.nodes.size()}, {id.index(), id.index() + 1}});
      first_node = mesh.nodes.size();
    }
  };
  int count = 1;
  for (const int n : slab.cells) count *= n;
  for (int linear = 0; linear < count; ++linear) {
    std::array<int, dim> cell{};
    for (int i = 0, rest = linear; i < dim; ++i) {
      cell[i] = rest % slab.cells[i];
      rest /= slab.cells[i];
    }
    add_cell(cell);
  }
  if (slab.block_per_element) return;
  mesh.blocks.push_back({body, {first_node, mesh.nodes.size()}, {first_element, mesh.elements.size()}});
}

template <int dim>
mesh::BlockMesh<dim> slab_mesh(const std::vector<Slab<dim>>& slabs) {
  mesh::BlockMesh<dim> mesh;
  for (const Slab<dim>& slab : slabs) add_slab(mesh, slab);
  return mesh;
}

// A unit-thick bar or a rod along x.
template <int dim>
Slab<dim> bar(double length, int cells, int across, double width) {
  Slab<dim> slab;
  slab.size.setConstant(width);
  slab.size[0] = length;
  slab.cells.fill(across);
  slab.cells[0] = cells;
  return slab;
}

namespace detail {

template <int dim>
double area_of(const mesh::BlockMesh<dim>& mesh, const mesh::Face<dim>& face) {
  const Point<dim> u = mesh.nodes[face.nodes[1]] - mesh.nodes[face.nodes[0]];
  if constexpr (dim == 3) return 0.5 * u.cross(mesh.nodes[face.nodes[2]] - mesh.nodes[face.nodes[0]]).norm();
  return u.norm();
}

// The semi-spring of `own`'s corner `i` on `other`, a face with the same corners.
template <int dim>
contact::Contact<dim> semi_spring(const mesh::BlockMesh<dim>& mesh, const mesh::Face<dim>& own, const mesh::Face<dim>& other,
                                  int i) {
  constexpr double indentation = 0.05;
  contact::Contact<dim> contact;
  contact.owner = own.block;
  contact.target = other.block;
  contact.owner_element = own.element;
  contact.target_element = other.element;
  contact.area = area_of(mesh, own) / dim;
  contact.length = mesh::element_mean_edge(mesh, own.element);
  contact.on_owner.nodes = own.nodes;
  contact.on_target.nodes = other.nodes;
  for (int j = 0; j < dim; ++j) {
    const Point<dim>& corner = mesh.nodes[own.nodes[j]];
    const double weight = indentation / dim + (i == j ? 1 - indentation : 0);
    contact.on_owner.weights[j] = weight;
    for (int m = 0; m < dim; ++m) {
      if ((corner - mesh.nodes[other.nodes[m]]).norm() < 1e-9) contact.on_target.weights[m] = weight;
    }
  }
  return contact;
}

}  // namespace detail

// Semi-springs between faces of different blocks that have the same corners, as the contact room would find them.
template <int dim>
contact::ContactSet<dim> matching_contacts(const mesh::BlockMesh<dim>& mesh) {
  const auto faces = mesh::boundary_faces(mesh);
  std::map<std::array<long, dim>, std::vector<FaceId>> by_centre;
  for (const FaceId f : faces.ids()) {
    Point<dim> sum = Point<dim>::Zero();
    for (const NodeId node : faces[f].nodes) sum += mesh.nodes[node];
    std::array<long, dim> key{};
    for (int i = 0; i < dim; ++i) key[i] = std::lround(sum[i] * 1e7);
    by_centre[key].push_back(f);
  }
  contact::ContactSet<dim> set;
  set.semi_springs = faces.size() * dim;
  for (const auto& entry : by_centre) {
    const std::vector<FaceId>& pair = entry.second;
    if (pair.size() != 2) continue;
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < dim; ++i) {
        set.contacts.push_back(detail::semi_spring(mesh, faces[pair[side]], faces[pair[1 - side]], i));
      }
    }
  }
  return set;
}

template <int dim>
HeatOptions options_for(const mesh::BlockMesh<dim>& mesh, double initial) {
  HeatOptions options;
  options.initial_temperature = Table<BodyId, Function>(mesh.bodies.size(), initial);
  return options;
}

// The part of space with low <= x <= high.
inline Aabb<3> between_x(double low, double high) {
  return {Eigen::Vector3d(low, -1e9, -1e9), Eigen::Vector3d(high, 1e9, 1e9)};
}

inline Region on(BodyId body, const std::optional<Aabb<3>>& within = {}, const std::optional<std::string>& surface = {}) {
  Region region;
  region.body = body;
  region.within = within;
  region.surface = surface;
  return region;
}

inline Boundary hold(BodyId body, double x, double temperature, const std::string& name) {
  Boundary boundary;
  boundary.region = on(body, between_x(x, x));
  boundary.condition = FixedTemperature{temperature};
  boundary.name = name;
  return boundary;
}

}  // namespace scree::thermal::test
