#include "engine/packing/near_pieces.h"

#include <algorithm>
#include <numeric>

namespace scree::packing {

PieceSet::PieceSet(const mesh::BlockMesh<3>& placed_mesh) : pieces(placed_mesh.blocks.size()) {
  for (const BlockId block : placed_mesh.blocks.ids()) {
    pieces[block] = mesh::convex_pieces(placed_mesh, block);
    for (const mesh::ConvexPiece& piece : pieces[block]) {
      Part part{block, placed_mesh.bodies[placed_mesh.blocks[block].body].fixed, placed(piece, Pose{}), {}};
      for (const auto& vertex : part.placed.vertices) part.box.extend(vertex);
      parts.push_back(std::move(part));
    }
  }
}

std::vector<std::pair<const Part*, const Part*>> near_pairs(const std::vector<Part>& parts, double range, Pairs asked) {
  Aabb<3> all;
  for (const Part& part : parts) all.extend(part.box);
  int axis = 0;
  if (!all.isEmpty()) all.sizes().maxCoeff(&axis);
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].box.min()[axis] < parts[b].box.min()[axis]; });
  std::vector<std::pair<const Part*, const Part*>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Part& part = parts[order[i]];
    const double end = part.box.max()[axis] + range;
    for (std::size_t j = i + 1; j < order.size() && parts[order[j]].box.min()[axis] <= end; ++j) {
      const Part& other = parts[order[j]];
      if (part.block == other.block || (asked != Pairs::all && part.fixed && other.fixed)) continue;
      if (part.box.squaredExteriorDistance(other.box) <= range * range) pairs.emplace_back(&part, &other);
    }
  }
  return pairs;
}

}  // namespace scree::packing
