#include "engine/packing/near_pieces.h"

#include "engine/packing/near_boxes.h"

namespace scree::packing {

namespace {

std::vector<BlockId> all_blocks(const mesh::BlockMesh<3>& mesh) {
  const auto ids = mesh.blocks.ids();
  return {ids.begin(), ids.end()};
}

}  // namespace

PieceSet::PieceSet(const mesh::BlockMesh<3>& placed_mesh) : PieceSet(placed_mesh, all_blocks(placed_mesh)) {}

PieceSet::PieceSet(const mesh::BlockMesh<3>& placed_mesh, const std::vector<BlockId>& blocks)
    : pieces(placed_mesh.blocks.size()) {
  for (const BlockId block : blocks) {
    pieces[block] = mesh::convex_pieces(placed_mesh, block);
    const Owner owner = owner_of(placed_mesh, block);
    for (const mesh::ConvexPiece& piece : pieces[block]) {
      Part part{owner, placed(piece, Pose{}), {}};
      for (const auto& vertex : part.placed.vertices) part.box.extend(vertex);
      parts.push_back(std::move(part));
    }
  }
}

std::vector<std::pair<const Part*, const Part*>> near_pairs(const std::vector<Part>& parts, double range, Pairs asked) {
  std::vector<Aabb<3>> boxes;
  boxes.reserve(parts.size());
  for (const Part& part : parts) boxes.push_back(part.box);
  std::vector<std::pair<const Part*, const Part*>> pairs;
  for_near_boxes<3>(boxes, range, [&](std::size_t i, std::size_t j) {
    if (boxes[i].squaredExteriorDistance(boxes[j]) > range * range || !is_asked(asked, parts[i], parts[j])) return;
    pairs.emplace_back(&parts[i], &parts[j]);
  });
  return pairs;
}

}  // namespace scree::packing
