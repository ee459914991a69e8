// Where the nodes are, for functions of place.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::thermal {

// A column for each node [m]; in 2-D z is 0.
template <int dim>
Eigen::Matrix3Xd places_of(const mesh::BlockMesh<dim>& mesh) {
  Eigen::Matrix3Xd places = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const NodeId node : mesh.nodes.ids()) places.col(node.value()).template head<dim>() = mesh.nodes[node];
  return places;
}

}  // namespace scree::thermal
