#include "engine/packing/blocks_in_others.h"

#include <algorithm>

#include "engine/packing/near_boxes.h"

namespace scree::packing {

namespace {

void mark_in_blocks(const mesh::BlockMesh<3>& mesh, const Table<BlockId, Aabb<3>>& boxes, double depth, Pairs asked,
                    Table<BlockId, char>& marked) {
  for_near_boxes<3>(boxes.raw(), -depth, [&](std::size_t i, std::size_t j) {
    const BlockId a{i}, b{j};
    if (!is_asked(asked, owner_of(mesh, a), owner_of(mesh, b))) return;
    marked[a] = 1;
    marked[b] = 1;
  });
}

// A body's box holds those of its blocks: where bodies are apart, no block is looked at.
void mark_in_bodies(const mesh::BlockMesh<3>& mesh, const Table<BlockId, Aabb<3>>& boxes, double depth,
                    Table<BlockId, char>& marked) {
  Table<BodyId, Aabb<3>> bodies(mesh.bodies.size());
  for (const BlockId block : mesh.blocks.ids()) bodies[mesh.blocks[block].body].extend(boxes[block]);
  Table<BodyId, std::vector<BodyId>> others(mesh.bodies.size());
  for_near_boxes<3>(bodies.raw(), -depth, [&](std::size_t i, std::size_t j) {
    others[BodyId{i}].emplace_back(j);
    others[BodyId{j}].emplace_back(i);
  });
  for (const BlockId block : mesh.blocks.ids()) {
    const std::vector<BodyId>& near = others[mesh.blocks[block].body];
    marked[block] = std::any_of(near.begin(), near.end(), [&](BodyId other) {
      const Aabb<3> common = boxes[block].intersection(bodies[other]);
      return (common.sizes().array() >= depth).all();
    });
  }
}

}  // namespace

template <int dim>
Table<BlockId, Aabb<dim>> block_boxes(const mesh::BlockMesh<dim>& mesh) {
  Table<BlockId, Aabb<dim>> boxes(mesh.blocks.size());
  for (const BlockId block : mesh.blocks.ids()) {
    for (const NodeId node : mesh.blocks[block].nodes) boxes[block].extend(mesh.nodes[node]);
  }
  return boxes;
}

std::vector<BlockId> blocks_in_others(const mesh::BlockMesh<3>& mesh, double depth, Pairs asked) {
  const Table<BlockId, Aabb<3>> boxes = block_boxes(mesh);
  Table<BlockId, char> marked(mesh.blocks.size(), 0);
  if (asked == Pairs::of_different_bodies) {
    mark_in_bodies(mesh, boxes, depth, marked);
  } else {
    mark_in_blocks(mesh, boxes, depth, asked, marked);
  }
  std::vector<BlockId> blocks;
  for (const BlockId block : mesh.blocks.ids()) {
    if (marked[block] != 0) blocks.push_back(block);
  }
  return blocks;
}

template Table<BlockId, Aabb<2>> block_boxes(const mesh::BlockMesh<2>&);
template Table<BlockId, Aabb<3>> block_boxes(const mesh::BlockMesh<3>&);

}  // namespace scree::packing
