#include "engine/packing/remaining.h"

#include <algorithm>
#include <limits>

namespace scree::packing {

namespace {

// The blocks of `kept`, one behind the other.
template <int dim>
mesh::BlockMesh<dim> blocks_of(const mesh::BlockMesh<dim>& all, const Table<BlockId, BlockId>& kept) {
  mesh::BlockMesh<dim> mesh;
  mesh.bodies = all.bodies;
  mesh.surface_names = all.surface_names;
  Table<NodeId, NodeId> places(all.nodes.size());  // not valid: of no block that is kept
  const auto moved = [&](auto nodes) {
    for (NodeId& node : nodes) node = node.valid() ? places[node] : node;
    return nodes;
  };
  for (const BlockId id : kept) {
    mesh::Block block = all.blocks[id];
    const std::size_t nodes = mesh.nodes.size(), elements = mesh.elements.size(), cells = mesh.cells.size();
    for (const NodeId node : block.nodes) places[node] = mesh.nodes.push_back(all.nodes[node]);
    for (const ElementId element : block.elements) mesh.elements.push_back(moved(all.elements[element]));
    for (const CellId cell : block.cells) mesh.cells.push_back({all.cells[cell].kind, moved(all.cells[cell].nodes)});
    block.nodes = {nodes, mesh.nodes.size()};
    block.elements = {elements, mesh.elements.size()};
    block.cells = {cells, mesh.cells.size()};
    mesh.blocks.push_back(block);
  }
  for (const mesh::SurfaceFace<dim>& face : all.surfaces) {
    if (places[face.nodes[0]].valid()) mesh.surfaces.push_back({moved(face.nodes), face.surface});
  }
  return mesh;
}

}  // namespace

std::vector<double> Places::in_packing(const Eigen::VectorXd& values) const {
  std::vector<double> all(all_nodes, std::numeric_limits<double>::quiet_NaN());
  auto value = values.begin();
  for (const IdRange<NodeId>& range : nodes) {
    for (const NodeId node : range) all[node.index()] = *value++;
  }
  return all;
}

template <int dim>
Remaining<dim> remaining(const Packing<dim>& packing) {
  Remaining<dim> result;
  result.mesh = placed_mesh(packing);
  Places& places = result.places;
  places.all_nodes = packing.mesh.nodes.size();
  const auto is_lost = [&](BlockId block) {
    return packing.settled &&
           std::binary_search(packing.settled->lost_blocks.begin(), packing.settled->lost_blocks.end(), block);
  };
  for (const BlockId block : packing.mesh.blocks.ids()) {
    if (is_lost(block)) continue;
    places.blocks.push_back(block);
    places.nodes.push_back(packing.mesh.blocks[block].nodes);
  }
  if (places.blocks.size() < packing.mesh.blocks.size()) result.mesh = blocks_of(result.mesh, places.blocks);
  return result;
}

template Remaining<2> remaining<2>(const Packing<2>&);
template Remaining<3> remaining<3>(const Packing<3>&);

}  // namespace scree::packing
