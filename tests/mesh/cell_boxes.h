// Boxes of cells on and beside each other, for the tests of their joints.
#pragma once

#include <cmath>

#include "engine/mesh/make_blocks.h"

namespace scree::mesh::test {

struct CellBox {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
  double mesh_size = 0.5;
  std::optional<CellKind> kind = CellKind::hexahedron;  // nothing: simplices
  double turn = 0;                                      // about z [rad]
};

template <int dim>
BlockMesh<dim> cell_boxes(const std::vector<CellBox>& boxes) {
  std::vector<BodySpec> bodies;
  for (const CellBox& box : boxes) {
    BodySpec body;
    body.name = "box" + std::to_string(bodies.size());
    body.shape = Box{.size = box.size};
    body.mesh_size = box.mesh_size;
    body.cells = box.kind;
    body.material = MaterialId{0};
    Pose pose;
    pose.translation = box.centre;
    pose.rotation = Eigen::AngleAxisd(box.turn, Eigen::Vector3d::UnitZ());
    body.arrangement = AtPoses{{pose}};
    bodies.push_back(body);
  }
  return make_blocks<dim>(bodies);
}

// Moves the nodes within their planes z = constant: no face there is a parallelogram any more, and the straight sides of a box
// about the axis stay straight.
inline void bend_sideways(BlockMesh<3>& mesh) {
  for (Point<3>& node : mesh.nodes) {
    const double x = node.x(), y = node.y();
    node.x() = x * (1 + 0.15 * y);
    node.y() = y * (1 - 0.1 * x);
  }
}

}  // namespace scree::mesh::test
