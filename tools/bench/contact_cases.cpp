#include "tools/bench/contact_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "engine/mesh/make_blocks.h"
#include "engine/rigid/settle.h"

namespace scree::bench {

namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 4>;

void add_tetrahedron(mesh::BlockMesh<3>& mesh, Corners corners) {
  const std::size_t node = mesh.nodes.size(), element = mesh.elements.size();
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = corners[i + 1] - corners[0];
  if (edges.determinant() < 0) std::swap(corners[0], corners[1]);
  for (const Vector3d& corner : corners) mesh.nodes.push_back(corner);
  mesh.elements.push_back({NodeId{node}, NodeId{node + 1}, NodeId{node + 2}, NodeId{node + 3}});
  mesh.blocks.push_back({BodyId{0}, {node, node + 4}, {element, element + 1}});
}

// Where number `i` stands in rows and layers of `side`.
Vector3d place_in_lattice(std::size_t i, std::size_t side) {
  const std::size_t row = i / side;
  const std::size_t layer = row / side;
  return {static_cast<double>(i % side), static_cast<double>(row % side), static_cast<double>(layer)};
}

// Calls `add` with the six tetrahedra around the diagonal of every cell of the unit cube.
template <class Add>
void cut_cube(std::size_t faces, const Add& add) {
  const auto cells = static_cast<std::size_t>(std::max(1L, std::lround(std::cbrt(static_cast<double>(faces) / 24))));
  const double size = 1.0 / static_cast<double>(cells);
  for (std::size_t cell = 0; cell < cells * cells * cells; ++cell) {
    std::array<int, 3> axes{0, 1, 2};
    do {
      Vector3d at = place_in_lattice(cell, cells);
      Corners corners;
      corners[0] = size * at;
      for (int i = 0; i < 3; ++i) {
        at[axes[i]] += 1;
        corners[i + 1] = size * at;
      }
      add(corners);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
}

mesh::BlockMesh<3> one_body() {
  mesh::BlockMesh<3> mesh;
  mesh.bodies.push_back({"rock", MaterialId{0}, false, Vector3d::Zero()});
  return mesh;
}

constexpr double meshed_cube_size = 0.0215;  // of a cube of 0.2 m: 4 thousand tetrahedra

mesh::BodySpec box(const char* name, const Vector3d& size, const Vector3d& centre, double mesh_size) {
  mesh::BodySpec body;
  body.name = name;
  body.shape = mesh::Box{size};
  body.arrangement = mesh::AtPoses{{Pose{centre}}};
  body.mesh_size = mesh_size;
  body.material = MaterialId{0};
  return body;
}

mesh::BlockMesh<3> settled(const std::vector<mesh::BodySpec>& bodies) {
  Material rock;
  rock.density = 2500;
  rock.friction = 0.8;
  rigid::SettleOptions options;
  options.limit = 2;
  options.step = 0.008;
  options.local_damping = 0.8;
  options.iterations = 20;
  return packing::placed_mesh(rigid::settle(mesh::make_blocks<3>(bodies), Table<MaterialId, Material>({rock}), options));
}

mesh::BodySpec plate() {
  mesh::BodySpec plate = box("plate", {1, 1, 0.05}, {0, 0, -0.025}, 0.1);
  plate.fixed = true;
  return plate;
}

mesh::BlockMesh<3> pile_of_tetrahedra() {
  mesh::BodySpec cube = box("cube", {0.2, 0.2, 0.2}, {0, 0, 0.12}, 0.05);
  cube.blocks = mesh::BlockRule::per_element;
  return settled({plate(), cube});
}

// Eight cubes of 4 thousand tetrahedra, dropped slantwise onto one another.
mesh::BlockMesh<3> pile_of_cubes() {
  mesh::BodySpec cubes = box("cubes", {0.2, 0.2, 0.2}, {0, 0, 0}, meshed_cube_size);
  std::vector<Pose> poses;
  for (int i = 0; i < 8; ++i) {
    const Eigen::AngleAxisd turn(0.4 * i, Vector3d(1, i, 2).normalized());
    const Vector3d place = Vector3d(0.22, 0.22, 0.36).cwiseProduct(place_in_lattice(i, 2)) + Vector3d(-0.11, -0.11, 0.2);
    poses.push_back({place, Eigen::Quaterniond(turn)});
  }
  cubes.arrangement = mesh::AtPoses{poses};
  return settled({plate(), cubes});
}

template <class IdType>
IdRange<IdType> moved(const IdRange<IdType>& range, std::size_t by) {
  return {range.first() + by, range.last() + by};
}

void append(mesh::BlockMesh<3>& mesh, const mesh::BlockMesh<3>& copy, const Vector3d& way) {
  const std::size_t first_node = mesh.nodes.size(), first_element = mesh.elements.size();
  for (const auto& node : copy.nodes) mesh.nodes.push_back(node + way);
  for (auto element : copy.elements) {
    for (NodeId& node : element) node = NodeId{node.index() + first_node};
    mesh.elements.push_back(element);
  }
  for (mesh::Block block : copy.blocks) {
    block.nodes = moved(block.nodes, first_node);
    block.elements = moved(block.elements, first_element);
    mesh.blocks.push_back(block);
  }
}

const mesh::BlockMesh<3>& meshed_cube() {
  static const mesh::BlockMesh<3> cube = mesh::make_blocks<3>({box("cube", {0.2, 0.2, 0.2}, {0, 0, 0}, meshed_cube_size)});
  return cube;
}

// So many of them each way.
mesh::BlockMesh<3> lattice_of_cubes(std::size_t side) {
  mesh::BlockMesh<3> mesh;
  mesh.bodies = meshed_cube().bodies;
  for (std::size_t i = 0; i < side * side * side; ++i) append(mesh, meshed_cube(), 0.2 * place_in_lattice(i, side));
  return mesh;
}

// Copies of a pile that give about `faces` boundary faces.
mesh::BlockMesh<3> side_by_side(const mesh::BlockMesh<3>& pile, std::size_t faces) {
  mesh::BlockMesh<3> mesh;
  mesh.bodies = pile.bodies;
  const auto copies = std::max<std::size_t>(1, faces / mesh::boundary_faces(pile).size());
  const auto row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(copies))));
  for (std::size_t i = 0; i < copies; ++i) append(mesh, pile, 1.1 * place_in_lattice(i, row));
  return mesh;
}

}  // namespace

mesh::BlockMesh<3> closed_lattice(std::size_t faces) {
  mesh::BlockMesh<3> mesh = one_body();
  cut_cube(faces, [&](const Corners& corners) { add_tetrahedron(mesh, corners); });
  return mesh;
}

mesh::BlockMesh<3> turned_lattice(std::size_t faces) {
  mesh::BlockMesh<3> mesh = one_body();
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  cut_cube(faces, [&](Corners corners) {
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(w, x, y, z).normalized();
    const Vector3d centre = std::accumulate(corners.begin(), corners.end(), Vector3d(0, 0, 0)) / 4;
    for (Vector3d& corner : corners) corner = centre + turn * (corner - centre);
    add_tetrahedron(mesh, corners);
  });
  return mesh;
}

mesh::BlockMesh<3> settled_piles(std::size_t faces) {
  static const mesh::BlockMesh<3> pile = pile_of_tetrahedra();
  return side_by_side(pile, faces);
}

mesh::BlockMesh<3> settled_cubes(std::size_t faces) {
  static const mesh::BlockMesh<3> pile = pile_of_cubes();
  return side_by_side(pile, faces);
}

mesh::BlockMesh<3> jointed_cubes(std::size_t faces) {
  const auto cubes = static_cast<double>(faces) / static_cast<double>(mesh::boundary_faces(meshed_cube()).size());
  return lattice_of_cubes(static_cast<std::size_t>(std::max(1L, std::lround(std::cbrt(cubes)))));
}

mesh::BlockMesh<3> jointed_eights(std::size_t faces) {
  static const mesh::BlockMesh<3> eight = lattice_of_cubes(2);
  return side_by_side(eight, faces);
}

}  // namespace scree::bench
