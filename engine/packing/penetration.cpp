#include "engine/packing/penetration.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "engine/packing/separation.h"

namespace scree::packing {

namespace {

struct Part {
  BlockId block;
  bool fixed = false;
  PlacedPiece placed;
  Aabb<3> box;
};

std::vector<Part> make_parts(const mesh::BlockMesh<3>& mesh, const Table<BlockId, std::vector<mesh::ConvexPiece>>& pieces) {
  std::vector<Part> parts;
  for (const BlockId block : mesh.blocks.ids()) {
    for (const mesh::ConvexPiece& piece : pieces[block]) {
      Part part{block, mesh.bodies[mesh.blocks[block].body].fixed, placed(piece, Pose{}), {}};
      for (const auto& vertex : part.placed.vertices) part.box.extend(vertex);
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

// Calls `visit(a, b)` for each pair of parts whose boxes are nearer than `range`: sorted along the axis on which they spread
// most, each is compared with those that begin before it ends.
template <class Visit>
void for_near_pairs(const std::vector<Part>& parts, double range, Visit visit) {
  Aabb<3> all;
  for (const Part& part : parts) all.extend(part.box);
  int axis = 0;
  if (!all.isEmpty()) all.sizes().maxCoeff(&axis);
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].box.min()[axis] < parts[b].box.min()[axis]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Part& part = parts[order[i]];
    const double end = part.box.max()[axis] + range;
    for (std::size_t j = i + 1; j < order.size() && parts[order[j]].box.min()[axis] <= end; ++j) {
      const Part& other = parts[order[j]];
      if (part.block == other.block || (part.fixed && other.fixed)) continue;
      if (part.box.squaredExteriorDistance(other.box) <= range * range) visit(part, other);
    }
  }
}

}  // namespace

Penetration measure_penetration(const mesh::BlockMesh<3>& placed_mesh, double contact_range) {
  Table<BlockId, std::vector<mesh::ConvexPiece>> pieces(placed_mesh.blocks.size());
  for (const BlockId block : placed_mesh.blocks.ids()) pieces[block] = mesh::convex_pieces(placed_mesh, block);
  std::map<std::pair<BlockId, BlockId>, double> depth;
  for_near_pairs(make_parts(placed_mesh, pieces), contact_range, [&](const Part& a, const Part& b) {
    const double distance = separation(a.placed, b.placed, contact_range).distance;
    if (distance > contact_range) return;
    double& deepest = depth[std::minmax(a.block, b.block)];
    deepest = std::max(deepest, -distance);
  });
  Penetration result;
  result.touching = depth.size();
  for (const auto& [pair, deepest] : depth) {
    result.mean += deepest / static_cast<double>(depth.size());
    if (deepest <= result.max) continue;
    result.max = deepest;
    result.first = pair.first;
    result.second = pair.second;
  }
  return result;
}

}  // namespace scree::packing
