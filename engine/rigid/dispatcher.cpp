#include "engine/rigid/dispatcher.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>

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
                       std::span<const BlockMotion> motions)
    : btCollisionDispatcher(&configuration), flights_(flights), homes_(homes), sleepers_(sleepers), motions_(motions) {
  setDispatcherFlags(getDispatcherFlags() & ~CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
}

void Dispatcher::dispatchAllCollisionPairs(btOverlappingPairCache* cache, const btDispatcherInfo& info, btDispatcher*) {
  btBroadphasePairArray& pairs = cache->getOverlappingPairArray();
  if (flights_.count() > 0) end_flights(pairs);
  add_algorithms(pairs);
  std::vector<std::vector<News>> news(chunk_count(static_cast<std::size_t>(pairs.size())));
  for_short_chunks(static_cast<std::size_t>(pairs.size()), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      look(pairs[static_cast<int>(i)], static_cast<int>(i), info.m_timeStep, news[chunk.number]);
    }
  });
  // A pair of compounds is as much work as many pairs of polyhedra.
  std::vector<int> compounds;
  for (const auto& part : news) {
    for (const News& at : part) {
      if (!at.contact) compounds.push_back(at.pair);
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
  claim(pairs, news);
  run_phases(std::array<int, 1>{static_cast<int>(news.size())}, 1, [&](int, int part) {
    for (const News& at : news[static_cast<std::size_t>(part)]) {
      if (!at.contact) continue;
      const auto [first, second] = motions_of(pairs[at.pair]);
      auto& algorithm = algorithm_of(pairs[at.pair]);
      algorithm.take(algorithm.pair_of(whole(*first), whole(*second), info.m_timeStep), *at.contact);
    }
  });
  for_each_compound(
      [&](CompoundCollision& algorithm, const Motions& blocks) { algorithm.take(*blocks[0], *blocks[1], info.m_timeStep); });
}

Dispatcher::Motions Dispatcher::motions_of(const btBroadphasePair& pair) const {
  const auto [first, second] = blocks_of(pair);
  return {&motions_[first], &motions_[second]};
}

// In the order of the pairs.
void Dispatcher::claim(const btBroadphasePairArray& pairs, const std::vector<std::vector<News>>& news) const {
  for (const auto& part : news) {
    for (const News& at : part) {
      const auto [first, second] = motions_of(pairs[at.pair]);
      if (at.contact) {
        algorithm_of(pairs[at.pair]).claim(*first, *second, *at.contact);
      } else {
        compound_algorithm_of(pairs[at.pair]).claim(*first, *second);
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

void Dispatcher::look(btBroadphasePair& pair, int number, double time_step, std::vector<News>& news) const {
  if (pair.m_algorithm == nullptr || stays_as_it_is(pair)) return;
  const auto [first, second] = motions_of(pair);
  if (first->piece == nullptr || second->piece == nullptr) {
    note(pair, false);
    news.push_back({number, std::nullopt});
    return;
  }
  PolyhedronCollision& algorithm = algorithm_of(pair);
  const auto looked_at = algorithm.pair_of(whole(*first), whole(*second), time_step);
  const auto contact = algorithm.look(looked_at);
  note(pair, algorithm.far(looked_at) && (!contact || contact->count == 0));
  if (contact) news.push_back({number, contact});
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
