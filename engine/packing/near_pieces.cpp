#include "engine/packing/near_pieces.h"

#include <algorithm>

namespace scree::packing {

namespace {

std::vector<BlockId> all_blocks(const mesh::BlockMesh<3>& mesh) {
  const auto ids = mesh.blocks.ids();
  return {ids.begin(), ids.end()};
}

bool is_asked(Pairs asked, const Part& a, const Part& b) {
  switch (asked) {
    case Pairs::with_a_free_block:
      return a.block != b.block && !(a.fixed && b.fixed);
    case Pairs::of_different_bodies:
      return a.body != b.body;
    case Pairs::all:
      break;
  }
  return a.block != b.block;
}

// Parts by strips of space, as wide as their boxes are in the mean, each strip in the order in which its boxes begin along it.
// A box is in all strips that it reaches, each with its boxes beside each other in memory.
struct Strips {
  struct Entry {
    Aabb<3> box;
    const Part* part = nullptr;
  };

  Strips(const std::vector<Part>& all, double range) {
    Aabb<3> box;
    for (const Part& part : all) box.extend(part.box);
    box.sizes().maxCoeff(&along);
    box.sizes().minCoeff(&across);
    across = along == across ? (along + 1) % 3 : 3 - along - across;
    low = box.min()[across];
    width = range;
    for (const Part& part : all) width += part.box.sizes()[across] / static_cast<double>(all.size());
    entries.resize(static_cast<std::size_t>(std::min(box.sizes()[across] / width, static_cast<double>(all.size()))) + 1);
    std::vector<const Part*> order;
    for (const Part& part : all) order.push_back(&part);
    std::stable_sort(order.begin(), order.end(),
                     [&](const Part* a, const Part* b) { return a->box.min()[along] < b->box.min()[along]; });
    for (const Part* part : order) {
      const std::size_t last = strip_at(part->box.max()[across] + range);
      for (std::size_t s = strip_at(part->box.min()[across]); s <= last; ++s) entries[s].push_back({part->box, part});
    }
  }

  [[nodiscard]] std::size_t strip_at(double place) const {
    return static_cast<std::size_t>(std::clamp((place - low) / width, 0.0, static_cast<double>(entries.size() - 1)));
  }

  // Of two that are near each other.
  [[nodiscard]] std::size_t first_of_both(const Entry& a, const Entry& b) const {
    return strip_at(std::max(a.box.min()[across], b.box.min()[across]));
  }

  int along = 0, across = 1;  // axes: along which all spread most, and next
  double low = 0, width = 0;  // [m]
  std::vector<std::vector<Entry>> entries;
};

}  // namespace

PieceSet::PieceSet(const mesh::BlockMesh<3>& placed_mesh) : PieceSet(placed_mesh, all_blocks(placed_mesh)) {}

PieceSet::PieceSet(const mesh::BlockMesh<3>& placed_mesh, const std::vector<BlockId>& blocks)
    : pieces(placed_mesh.blocks.size()) {
  for (const BlockId block : blocks) {
    pieces[block] = mesh::convex_pieces(placed_mesh, block);
    const BodyId body = placed_mesh.blocks[block].body;
    for (const mesh::ConvexPiece& piece : pieces[block]) {
      Part part{block, body, placed_mesh.bodies[body].fixed, placed(piece, Pose{}), {}};
      for (const auto& vertex : part.placed.vertices) part.box.extend(vertex);
      parts.push_back(std::move(part));
    }
  }
}

std::vector<std::pair<const Part*, const Part*>> near_pairs(const std::vector<Part>& parts, double range, Pairs asked) {
  std::vector<std::pair<const Part*, const Part*>> pairs;
  if (parts.empty()) return pairs;
  const Strips strips(parts, range);
  for (std::size_t s = 0; s < strips.entries.size(); ++s) {
    const std::vector<Strips::Entry>& strip = strips.entries[s];
    for (std::size_t i = 0; i < strip.size(); ++i) {
      const double end = strip[i].box.max()[strips.along] + range;
      for (std::size_t j = i + 1; j < strip.size() && strip[j].box.min()[strips.along] <= end; ++j) {
        if (strip[i].box.squaredExteriorDistance(strip[j].box) > range * range) continue;
        if (!is_asked(asked, *strip[i].part, *strip[j].part) || strips.first_of_both(strip[i], strip[j]) != s) continue;
        pairs.emplace_back(strip[i].part, strip[j].part);
      }
    }
  }
  return pairs;
}

}  // namespace scree::packing
