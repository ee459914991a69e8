#include "engine/packing/packing.h"

namespace scree::packing {

template <int dim>
Packing<dim> unmoved(mesh::BlockMesh<dim> mesh) {
  const std::size_t blocks = mesh.blocks.size();
  return {std::move(mesh), Table<BlockId, Pose>(blocks), std::nullopt, {}};
}

template <int dim>
mesh::BlockMesh<dim> placed_mesh(const Packing<dim>& packing) {
  mesh::BlockMesh<dim> placed = packing.mesh;
  for (const BlockId block : placed.blocks.ids()) {
    const Pose& pose = packing.poses[block];
    placed.blocks[block].orientation = pose.rotation * placed.blocks[block].orientation;
    for (const NodeId node : placed.blocks[block].nodes) {
      Eigen::Vector3d reference = Eigen::Vector3d::Zero();
      reference.head<dim>() = placed.nodes[node];
      placed.nodes[node] = (pose * reference).template head<dim>();
    }
  }
  return placed;
}

template Packing<2> unmoved<2>(mesh::BlockMesh<2>);
template Packing<3> unmoved<3>(mesh::BlockMesh<3>);
template mesh::BlockMesh<2> placed_mesh<2>(const Packing<2>&);
template mesh::BlockMesh<3> placed_mesh<3>(const Packing<3>&);

}  // namespace scree::packing
