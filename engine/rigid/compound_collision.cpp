#include "engine/rigid/compound_collision.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

using Numbers = std::array<int, 2>;

// Only of a block of several pieces.
const btCompoundShape& compound_of(const BlockMotion& block) {
  return static_cast<const btCompoundShape&>(*block.body->getCollisionShape());
}

const PolyhedronShape& shape_of(const BlockMotion& block, int number) {
  const btCollisionShape& shape =
      block.placed != nullptr ? *block.body->getCollisionShape() : *compound_of(block).getChildShape(number);
  return static_cast<const PolyhedronShape&>(shape);
}

// All pieces have the block's frame.
Side piece_of(const BlockMotion& block, int number) {
  if (block.placed != nullptr) return whole(block);
  const PolyhedronShape& piece = shape_of(block, number);
  return {&block, piece.radius(), &piece};
}

// The numbers of a block's pieces whose boxes, in the block's frame, meet a box in that frame.
std::vector<int> pieces_in(const BlockMotion& block, const btVector3& low, const btVector3& high) {
  struct Found final : btDbvt::ICollide {
    std::vector<int> numbers;
    void Process(const btDbvtNode* leaf) override { numbers.push_back(leaf->dataAsInt); }
  };
  if (block.placed != nullptr) return {0};
  Found found;
  const btDbvt& tree = *compound_of(block).getDynamicAabbTree();
  tree.collideTV(tree.m_root, btDbvtVolume::FromMM(low, high), found);
  return found.numbers;
}

// All pairs of pieces of which no point may come nearer than `reach` but these, ascending.
std::vector<Numbers> near_pieces(const BlockMotion& first, const BlockMotion& second, double reach) {
  const btTransform to_first = first.pose.inverseTimes(second.pose);
  const btVector3 around(reach, reach, reach);
  btVector3 low, high;
  first.body->getCollisionShape()->getAabb(to_first.inverse(), low, high);
  std::vector<Numbers> near;
  for (const int of_second : pieces_in(second, low - around, high + around)) {
    btVector3 piece_low, piece_high;
    shape_of(second, of_second).getAabb(to_first, piece_low, piece_high);
    for (const int of_first : pieces_in(first, piece_low - around, piece_high + around)) near.push_back({of_first, of_second});
  }
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace

void CompoundCollision::look(const BlockMotion& first, const BlockMotion& second, double time_step) {
  keep(near_pieces(first, second, reach_of(ranges_, whole(first), whole(second), time_step)));
  for (Pieces& pair : pieces_) {
    const Side of_first = piece_of(first, pair.numbers[0]), of_second = piece_of(second, pair.numbers[1]);
    const auto looked_at = pair.collision->pair_of(of_first, of_second, time_step);
    pair.news.reset();
    if (!pair.collision->still_holds(looked_at)) pair.news = pair.collision->look(looked_at);
  }
}

void CompoundCollision::claim(const BlockMotion& first, const BlockMotion& second) {
  dropped_.clear();
  for (const Pieces& pair : pieces_) {
    if (pair.news) pair.collision->claim(first, second, *pair.news);
  }
}

void CompoundCollision::take(const BlockMotion& first, const BlockMotion& second, double time_step) {
  for (const Pieces& pair : pieces_) {
    if (!pair.news) continue;
    const Side of_first = piece_of(first, pair.numbers[0]), of_second = piece_of(second, pair.numbers[1]);
    pair.collision->take(pair.collision->pair_of(of_first, of_second, time_step), *pair.news);
  }
}

// Pairs that stay near keep their contacts.
void CompoundCollision::keep(const std::vector<Numbers>& near) {
  std::vector<Pieces> kept;
  kept.reserve(near.size());
  auto old = pieces_.begin();
  const auto drop_before = [&](const Numbers& numbers) {
    for (; old != pieces_.end() && old->numbers < numbers; ++old) dropped_.push_back(std::move(*old));
  };
  for (const Numbers& numbers : near) {
    drop_before(numbers);
    if (old != pieces_.end() && old->numbers == numbers) {
      kept.push_back(std::move(*old++));
    } else {
      btCollisionAlgorithmConstructionInfo info(m_dispatcher, 1);
      kept.push_back({numbers, std::make_unique<PolyhedronCollision>(info, ranges_, contacts_)});
      kept.back().collision->ask_for_surfaces();
    }
  }
  drop_before({std::numeric_limits<int>::max(), 0});
  pieces_ = std::move(kept);
}

}  // namespace scree::rigid
