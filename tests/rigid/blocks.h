// Small scenes, built by hand.
#pragma once

#include <array>
#include <utility>

#include "engine/rigid/settle.h"

namespace scree::rigid::testing {

using Eigen::Vector3d;

constexpr double g = 9.81;  // of SettleOptions [m/s2]

// A fall of this time, whether anything comes to rest or not.
inline SettleOptions for_time(double limit) {
  SettleOptions options;
  options.limit = limit;
  options.rest_speed = 0;
  return options;
}

// A body of one box, turned about its centre: six tetrahedra around its diagonal.
inline BlockId add_box(mesh::BlockMesh<3>& mesh, const Vector3d& size, const Pose& pose, bool fixed,
                       const Vector3d& velocity = Vector3d::Zero()) {
  const BodyId body = mesh.bodies.push_back({"box", MaterialId{0}, fixed, velocity});
  const std::size_t node = mesh.nodes.size();
  const std::size_t element = mesh.elements.size();
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
    mesh.nodes.push_back(pose * size.cwiseProduct(corner));
  }
  for (const auto& [a, b] : {std::pair{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}) {
    mesh.elements.push_back({NodeId{node}, NodeId{node + std::size_t(a)}, NodeId{node + std::size_t(b)}, NodeId{node + 7}});
  }
  return mesh.blocks.push_back({body, {node, node + 8}, {element, element + 6}});
}

inline BlockId add_box(mesh::BlockMesh<3>& mesh, const Vector3d& size, const Vector3d& centre, bool fixed,
                       const Vector3d& velocity = Vector3d::Zero()) {
  return add_box(mesh, size, Pose{centre, Eigen::Quaterniond::Identity()}, fixed, velocity);
}

// A fixed square plate below z = 0.
inline mesh::BlockMesh<3> plate(double width = 2) {
  mesh::BlockMesh<3> mesh;
  add_box(mesh, {width, width, 0.1}, {0, 0, -0.05}, true);
  return mesh;
}

inline BlockId add_tetrahedron(mesh::BlockMesh<3>& mesh, const std::array<Vector3d, 4>& corners, bool fixed = false) {
  const BodyId body = mesh.bodies.push_back({"tetrahedron", MaterialId{0}, fixed, Vector3d::Zero()});
  const std::size_t node = mesh.nodes.size();
  const std::size_t element = mesh.elements.size();
  for (const Vector3d& corner : corners) mesh.nodes.push_back(corner);
  mesh.elements.push_back({NodeId{node}, NodeId{node + 1}, NodeId{node + 2}, NodeId{node + 3}});
  return mesh.blocks.push_back({body, {node, node + 4}, {element, element + 1}});
}

inline Table<MaterialId, Material> material(double friction, double restitution = 0) {
  Material rock;
  rock.name = "rock";
  rock.density = 2500;
  rock.friction = friction;
  rock.restitution = restitution;
  Table<MaterialId, Material> materials;
  materials.push_back(rock);
  return materials;
}

}  // namespace scree::rigid::testing
