// Small meshes for the contact tests.
#pragma once

#include <random>
#include <vector>

#include "contact/find_contacts.h"

namespace scree::contact::testing {

template <int dim>
using Simplex = std::array<Point<dim>, dim + 1>;

// One block: simplices over nodes of their own (`loose`), or over common nodes found by position.
template <int dim>
using BlockOf = std::vector<Simplex<dim>>;

template <int dim>
mesh::BlockMesh<dim> mesh_of(const std::vector<BlockOf<dim>>& blocks) {
  mesh::BlockMesh<dim> mesh;
  mesh.bodies.push_back({"body", MaterialId{0}, false, Eigen::Vector3d::Zero()});
  for (const auto& simplices : blocks) {
    const std::size_t first_node = mesh.nodes.size(), first_element = mesh.elements.size();
    for (const auto& simplex : simplices) {
      typename mesh::BlockMesh<dim>::Element element;
      for (int i = 0; i <= dim; ++i) {
        std::size_t node = first_node;
        while (node < mesh.nodes.size() && mesh.nodes[NodeId{node}] != simplex[i]) ++node;
        if (node == mesh.nodes.size()) mesh.nodes.push_back(simplex[i]);
        element[i] = NodeId{node};
      }
      mesh.elements.push_back(element);
      const ElementId last{mesh.elements.size() - 1};
      if (mesh::element_volume(mesh, last) < 0) std::swap(mesh.elements[last][0], mesh.elements[last][1]);
    }
    mesh.blocks.push_back({BodyId{0}, {first_node, mesh.nodes.size()}, {first_element, mesh.elements.size()}});
  }
  return mesh;
}

template <int dim>
mesh::BlockMesh<dim> each_its_own(const BlockOf<dim>& simplices) {
  std::vector<BlockOf<dim>> blocks;
  for (const auto& simplex : simplices) blocks.push_back({simplex});
  return mesh_of<dim>(blocks);
}

// A box cut into 6 tetrahedra around a diagonal (a rectangle into 2 triangles), from `low` to `low + size`.
template <int dim>
BlockOf<dim> box(const Point<dim>& low, const Point<dim>& size) {
  BlockOf<dim> simplices;
  std::array<int, dim> axes;
  for (int i = 0; i < dim; ++i) axes[i] = i;
  do {
    Simplex<dim> simplex;
    simplex[0] = low;
    for (int i = 0; i < dim; ++i) {
      simplex[i + 1] = simplex[i];
      simplex[i + 1][axes[i]] = low[axes[i]] + size[axes[i]];
    }
    simplices.push_back(simplex);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return simplices;
}

inline Point<3> at(double x, double y, double z) {
  return {x, y, z};
}

// Simplices of edges between about half and twice `size`, thrown into a box; none flatter than a tenth of a regular one.
template <int dim>
BlockOf<dim> random_simplices(std::size_t count, double box_size, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto draw = [&]() -> Point<dim> { return Point<dim>::NullaryExpr([&]() { return unit(random); }); };
  BlockOf<dim> simplices;
  while (simplices.size() < count) {
    const Point<dim> centre = box_size * draw();
    Simplex<dim> simplex;
    for (auto& corner : simplex) corner = centre + size * draw();
    Eigen::Matrix<double, dim, dim> edges;
    for (int i = 0; i < dim; ++i) edges.col(i) = (simplex[i + 1] - simplex[0]) / size;
    if (std::abs(edges.determinant()) > 0.3) simplices.push_back(simplex);
  }
  return simplices;
}

// The ring of Li & Feng (2016), section 2.2: radii 2 and 5 m, 8 x 60 cells cut into two triangles each.
inline BlockOf<2> ring() {
  BlockOf<2> triangles;
  const auto node = [](int radial, int angular) -> Point<2> {
    const double radius = 2 + 3.0 * radial / 8, angle = 2 * 3.14159265358979323846 * (angular % 60) / 60;
    return {radius * std::cos(angle), radius * std::sin(angle)};
  };
  for (int r = 0; r < 8; ++r) {
    for (int a = 0; a < 60; ++a) {
      triangles.push_back({node(r, a), node(r + 1, a), node(r + 1, a + 1)});
      triangles.push_back({node(r, a), node(r + 1, a + 1), node(r, a + 1)});
    }
  }
  return triangles;
}

}  // namespace scree::contact::testing
