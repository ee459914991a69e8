// The pairs that are known, beside Bullet's own list of them.
#include "engine/rigid/pair_cache.h"

#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scree::rigid {
namespace {

std::vector<btBroadphaseProxy> proxies(int count) {
  std::vector<btBroadphaseProxy> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    all[i].m_uniqueId = i + 1;
    all[i].m_collisionFilterGroup = all[i].m_collisionFilterMask = btBroadphaseProxy::AllFilter;
  }
  return all;
}

// As they stand in the list, which is what the order of contacts follows from.
template <class Cache>
std::vector<std::pair<int, int>> listed(Cache& cache) {
  std::vector<std::pair<int, int>> pairs;
  const btBroadphasePairArray& array = cache.getOverlappingPairArray();
  for (int i = 0; i < array.size(); ++i) pairs.emplace_back(array[i].m_pProxy0->getUid(), array[i].m_pProxy1->getUid());
  return pairs;
}

TEST(PairCache, ListsThePairsOfBulletsOwnCacheInTheSameOrder) {
  std::vector<btBroadphaseProxy> blocks = proxies(400);  // more than are looked through for a floor
  PairCache cache;
  btHashedOverlappingPairCache bullets;
  std::mt19937 generator(3);
  const auto any = [&] { return static_cast<int>(generator() % 40); };
  for (int i = 1; i < 400; ++i) {  // the first lies under all others
    cache.addOverlappingPair(&blocks[0], &blocks[i]);
    bullets.addOverlappingPair(&blocks[0], &blocks[i]);
  }
  for (int i = 0; i < 20'000; ++i) {
    btBroadphaseProxy* first = &blocks[any()];
    btBroadphaseProxy* second = &blocks[any()];
    if (first == second) continue;
    if (generator() % 3 != 0) {
      cache.addOverlappingPair(first, second);
      bullets.addOverlappingPair(first, second);
    } else {
      cache.removeOverlappingPair(first, second, nullptr);
      bullets.removeOverlappingPair(first, second, nullptr);
    }
  }
  EXPECT_GT(cache.getNumOverlappingPairs(), 400);
  EXPECT_EQ(listed(cache), listed(bullets));
}

TEST(PairCache, ABodyThatIsTakenAwayTakesItsPairsWithIt) {
  std::vector<btBroadphaseProxy> blocks = proxies(5);
  PairCache cache;
  for (int i = 1; i < 5; ++i) cache.addOverlappingPair(&blocks[0], &blocks[i]);
  cache.addOverlappingPair(&blocks[1], &blocks[2]);
  cache.removeOverlappingPairsContainingProxy(&blocks[0], nullptr);
  EXPECT_EQ(listed(cache), (std::vector<std::pair<int, int>>{{2, 3}}));
  EXPECT_NE(cache.addOverlappingPair(&blocks[0], &blocks[1]), nullptr);  // is new again
}

}  // namespace
}  // namespace scree::rigid
