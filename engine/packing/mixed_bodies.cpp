#include "engine/packing/mixed_bodies.h"

#include <algorithm>

namespace scree::packing {

namespace {

template <int dim>
bool overlap_by(double depth, const Aabb<dim>& a, const Aabb<dim>& b) {
  return ((a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).array() > depth).all();
}

template <int dim>
Table<BodyId, std::vector<BodyId>> bodies_in_each_other(const Table<BodyId, Aabb<dim>>& boxes, double depth) {
  std::vector<BodyId> order;
  for (const BodyId body : boxes.ids()) order.push_back(body);
  std::stable_sort(order.begin(), order.end(), [&](BodyId a, BodyId b) { return boxes[a].min().x() < boxes[b].min().x(); });
  Table<BodyId, std::vector<BodyId>> others(boxes.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Aabb<dim>& box = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min().x() < box.max().x(); ++j) {
      if (!overlap_by(depth, box, boxes[order[j]])) continue;
      others[order[i]].push_back(order[j]);
      others[order[j]].push_back(order[i]);
    }
  }
  return others;
}

}  // namespace

template <int dim>
std::vector<BlockId> blocks_in_other_bodies(const mesh::BlockMesh<dim>& mesh, double depth) {
  Table<BlockId, Aabb<dim>> block_boxes(mesh.blocks.size());
  Table<BodyId, Aabb<dim>> body_boxes(mesh.bodies.size());
  for (const BlockId block : mesh.blocks.ids()) {
    for (const NodeId node : mesh.blocks[block].nodes) block_boxes[block].extend(mesh.nodes[node]);
    body_boxes[mesh.blocks[block].body].extend(block_boxes[block]);
  }
  const auto others = bodies_in_each_other(body_boxes, depth);
  std::vector<BlockId> blocks;
  for (const BlockId block : mesh.blocks.ids()) {
    const std::vector<BodyId>& near = others[mesh.blocks[block].body];
    if (std::any_of(near.begin(), near.end(),
                    [&](BodyId other) { return overlap_by(depth, block_boxes[block], body_boxes[other]); })) {
      blocks.push_back(block);
    }
  }
  return blocks;
}

template std::vector<BlockId> blocks_in_other_bodies(const mesh::BlockMesh<2>&, double);
template std::vector<BlockId> blocks_in_other_bodies(const mesh::BlockMesh<3>&, double);

}  // namespace scree::packing
