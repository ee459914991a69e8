#include "engine/packing/penetration.h"

#include <algorithm>
#include <map>

namespace scree::packing {

Penetration measure_penetration(const PieceSet& pieces, double contact_range, std::span<const BlockId> lost, Pairs asked) {
  const auto is_lost = [&](const Part* part) { return std::binary_search(lost.begin(), lost.end(), part->block); };
  std::map<std::pair<BlockId, BlockId>, double> depth;
  for (const auto& [a, b] : near_pairs(pieces.parts, contact_range, asked)) {
    if (is_lost(a) || is_lost(b)) continue;
    const double distance = separation(a->placed, b->placed, contact_range).distance;
    if (distance > contact_range) continue;
    double& deepest = depth[std::minmax(a->block, b->block)];
    deepest = std::max(deepest, -distance);
  }
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
