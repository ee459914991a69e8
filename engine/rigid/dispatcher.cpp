#include "engine/rigid/dispatcher.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "engine/base/phases.h"
#include "engine/rigid/compound_collision.h"

namespace scree::rigid {

namespace {

const btCollisionObject& object_of(const btBroadphaseProxy* proxy) {
  return *static_cast<const btCollisionObject*>(proxy->m_clientObject);
}

btCollisionObjectWrapper wrapped(const btCollisionObject& object) {
  return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
}

PolyhedronCollision& algorithm_of(const btBroadphasePair& pair) {
  return static_cast<PolyhedronCollision&>(*pair.m_algorithm);
}

CompoundCollision& compound_algorithm_of(const btBroadphasePair& pair) {
  return static_cast<CompoundCollision&>(*pair.m_algorithm);
}

int block_of(const btBroadphaseProxy* proxy) {
  return object_of(proxy).getUserIndex();
}

// What is noted in a pair that was looked at, so that the next look may read nothing else: its blocks, from 1 on, and as
// negative numbers unless they were found far apart.
struct SeenBlocks {
  std::int32_t first, second;
};
static_assert(sizeof(SeenBlocks) == sizeof(void*));

std::array<int, 2> blocks_of(const btBroadphasePair& pair) {
  if (pair.m_internalInfo1 == nullptr) return {block_of(pair.m_pProxy0), block_of(pair.m_pProxy1)};
  const auto [first, second] = std::bit_cast<SeenBlocks>(pair.m_internalInfo1);
  return {std::abs(first) - 1, std::abs(second) - 1};
}

void note(btBroadphasePair& pair, bool far) {
  const auto [first, second] = blocks_of(pair);
  const SeenBlocks blocks{first + 1, second + 1};
  pair.m_internalInfo1 = std::bit_cast<void*>(far ? blocks : SeenBlocks{-blocks.first, -blocks.second});
}

}  // namespace

Dispatcher::Dispatcher(CollisionConfiguration& configuration, Flights& flights, const Homes& homes, const Sleepers& sleepers,
                       std::span<const BlockMotion> motions, std::span<packing::PlacedPiece> placed)
    : btCollisionDispatcher(&configuration),
      flights_(flights),
      homes_(homes),
      sleepers_(sleepers),
      motions_(motions),
      placed_(placed),
      to_place_(motions.size()) {
  setDispatcherFlags(getDispatcherFlags() & ~CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
}

void Dispatcher::dispatchAllCollisionPairs(btOverlappingPairCache* cache, const btDispatcherInfo& info, btDispatcher*) {
  btBroadphasePairArray& pairs = cache->getOverlappingPairArray();
  if (flights_.count() > 0) end_flights(pairs);
  add_algorithms(pairs);
  ask_all(pairs, info.m_timeStep);
  place_blocks();
  const auto for_each_news = [&](const auto& use) {
    run_phases(std::array<int, 1>{static_cast<int>(news_.size())}, 1, [&](int, int part) {
      for (News& at : news_[static_cast<std::size_t>(part)]) {
        if (!at.of_pieces) use(pairs[at.pair], at);
      }
    });
  };
  for_each_news([&](btBroadphasePair& pair, News& at) { look(pair, info.m_timeStep, at); });
  // A pair of compounds is as much work as many pairs of polyhedra.
  std::vector<int> compounds;
  for (const auto& part : news_) {
    for (const News& at : part) {
      if (at.of_pieces) compounds.push_back(at.pair);
    }
  }
  const auto for_each_compound = [&](const auto& use) {
    run_phases(std::array<int, 1>{static_cast<int>(compounds.size())}, 1, [&](int, int i) {
      const btBroadphasePair& pair = pairs[compounds[static_cast<std::size_t>(i)]];
      use(compound_algorithm_of(pair), motions_of(pair));
    });
  };
  for_each_compound(
      [&](CompoundCollision& algorithm, const Motions& blocks) { algorithm.look(*blocks[0], *blocks[1], info.m_timeStep); });
  claim(pairs);
  for_each_news([&](const btBroadphasePair& pair, const News& at) {
    algorithm_of(pair).take(sides_of(pair, info.m_timeStep), at.contact);
  });
  for_each_compound(
      [&](CompoundCollision& algorithm, const Motions& blocks) { algorithm.take(*blocks[0], *blocks[1], info.m_timeStep); });
}

Dispatcher::Motions Dispatcher::motions_of(const btBroadphasePair& pair) const {
  const auto [first, second] = blocks_of(pair);
  return {&motions_[first], &motions_[second]};
}

PolyhedronCollision::Pair Dispatcher::sides_of(const btBroadphasePair& pair, double time_step) const {
  const auto [first, second] = motions_of(pair);
  return algorithm_of(pair).pair_of(whole(*first), whole(*second), time_step);
}

// In the order of the pairs.
void Dispatcher::claim(const btBroadphasePairArray& pairs) const {
  for (const auto& part : news_) {
    for (const News& at : part) {
      const auto [first, second] = motions_of(pairs[at.pair]);
      if (at.of_pieces) {
        compound_algorithm_of(pairs[at.pair]).claim(*first, *second);
      } else {
        algorithm_of(pairs[at.pair]).claim(*first, *second, at.contact);
      }
    }
  }
}

bool Dispatcher::stays_as_it_is(const btBroadphasePair& pair) const {
  if (pair.m_internalInfo1 == nullptr) return false;
  const auto [first, second] = std::bit_cast<SeenBlocks>(pair.m_internalInfo1);
  if (first > 0 && homes_.at_home(first - 1) && homes_.at_home(second - 1)) return true;
  return sleepers_.still(std::abs(first) - 1) && sleepers_.still(std::abs(second) - 1);
}

void Dispatcher::ask_all(btBroadphasePairArray& pairs, double time_step) {
  news_.resize(chunk_count(static_cast<std::size_t>(pairs.size())));
  for_short_chunks(static_cast<std::size_t>(pairs.size()), [&](Chunk chunk) {
    news_[chunk.number].clear();
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      ask(pairs[static_cast<int>(i)], static_cast<int>(i), time_step, news_[chunk.number]);
    }
  });
}

void Dispatcher::ask(btBroadphasePair& pair, int number, double time_step, std::vector<News>& news) {
  if (pair.m_algorithm == nullptr || stays_as_it_is(pair)) return;
  const auto [first, second] = motions_of(pair);
  const bool of_pieces = first->placed == nullptr || second->placed == nullptr;
  if (!of_pieces) {
    PolyhedronCollision& algorithm = algorithm_of(pair);
    const auto asked_for = sides_of(pair, time_step);
    if (algorithm.still_holds(asked_for)) {
      note(pair, algorithm.far(asked_for));
      return;
    }
  }
  note(pair, false);
  for (const int block : blocks_of(pair)) std::atomic_ref(to_place_[block]).store(1, std::memory_order_relaxed);
  news.push_back({number, of_pieces, {}});
}

void Dispatcher::place_blocks() {
  for_short_chunks(to_place_.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      if (std::exchange(to_place_[i], 0) != 0 && motions_[i].placed != nullptr) place(motions_[i], placed_[i]);
    }
  });
}

void Dispatcher::look(btBroadphasePair& pair, double time_step, News& news) const {
  PolyhedronCollision& algorithm = algorithm_of(pair);
  const auto looked_at = sides_of(pair, time_step);
  news.contact = algorithm.look(looked_at);
  note(pair, algorithm.far(looked_at) && news.contact.count == 0);
}

void Dispatcher::end_flights(const btBroadphasePairArray& pairs) {
  for (int i = 0; i < pairs.size(); ++i) flights_.meet(block_of(pairs[i].m_pProxy0), block_of(pairs[i].m_pProxy1));
}

// Bullet makes them one at a time; few pairs are new.
void Dispatcher::add_algorithms(btBroadphasePairArray& pairs) {
  std::vector<std::vector<int>> without(chunk_count(static_cast<std::size_t>(pairs.size())));
  for_short_chunks(static_cast<std::size_t>(pairs.size()), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const btBroadphasePair& pair = pairs[static_cast<int>(i)];
      if (pair.m_algorithm != nullptr || flights_.together(block_of(pair.m_pProxy0), block_of(pair.m_pProxy1))) continue;
      without[chunk.number].push_back(static_cast<int>(i));
    }
  });
  for (const auto& part : without) {
    for (const int i : part) {
      const btCollisionObject &first = object_of(pairs[i].m_pProxy0), &second = object_of(pairs[i].m_pProxy1);
      if (!needsCollision(&first, &second)) continue;
      const btCollisionObjectWrapper of_first = wrapped(first), of_second = wrapped(second);
      pairs[i].m_algorithm = findAlgorithm(&of_first, &of_second, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    }
  }
}

}  // namespace scree::rigid
