// Bullet's cache of pairs whose boxes overlap, with a quicker answer to the question that its broad phase asks most: whether a
// pair is known already. Each step finds nearly all pairs of a block that moved anew, and Bullet looks every one up in a table
// that is larger than the processor's caches.
#pragma once

#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

namespace scree::rigid {

class PairCache final : public btHashedOverlappingPairCache {
 public:
  // Returns nothing for a pair that is known; Bullet's tree of boxes, which calls this, does not look at what it returns.
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second) override;
  void* removeOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second, btDispatcher* dispatcher) override;

 private:
  [[nodiscard]] bool is_known(int first, int second);

  std::vector<std::vector<int>> partners_;  // of each proxy
};

}  // namespace scree::rigid
