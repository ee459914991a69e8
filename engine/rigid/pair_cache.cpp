#include "engine/rigid/pair_cache.h"

#include <algorithm>

namespace scree::rigid {

namespace {

void erase(std::vector<int>& partners, int partner) {
  *std::find(partners.begin(), partners.end(), partner) = partners.back();
  partners.pop_back();
}

// Without a branch for each.
bool contains(const std::vector<int>& partners, int partner) {
  int found = 0;
  for (const int other : partners) found |= other == partner ? 1 : 0;
  return found != 0;
}

}  // namespace

// Pairs that follow each other are of one block, the second: its list is in the nearest cache. That of a floor on which all
// blocks lie would be too long.
bool PairCache::is_known(int first, int second) {
  constexpr std::size_t many = 256;
  const auto most = static_cast<std::size_t>(std::max(first, second));
  if (most >= partners_.size()) partners_.resize(most + 1);
  return partners_[second].size() > many ? contains(partners_[first], second) : contains(partners_[second], first);
}

btBroadphasePair* PairCache::addOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second) {
  const int a = first->getUid(), b = second->getUid();
  if (is_known(a, b)) return nullptr;
  btBroadphasePair* pair = btHashedOverlappingPairCache::addOverlappingPair(first, second);
  if (pair == nullptr) return nullptr;
  partners_[a].push_back(b);
  partners_[b].push_back(a);
  return pair;
}

void* PairCache::removeOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second, btDispatcher* dispatcher) {
  const int a = first->getUid(), b = second->getUid();
  if (is_known(a, b)) {
    erase(partners_[a], b);
    erase(partners_[b], a);
  }
  return btHashedOverlappingPairCache::removeOverlappingPair(first, second, dispatcher);
}

}  // namespace scree::rigid
