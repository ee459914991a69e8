// Which pairs are looked at in a step, and by whom.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include "engine/rigid/collision_configuration.h"
#include "engine/rigid/flights.h"
#include "engine/rigid/homes.h"
#include "engine/rigid/polyhedron_collision.h"
#include "engine/rigid/sleepers.h"

namespace scree::rigid {

// Looks at the pairs of polyhedra on all threads, then takes over what is new in the order of the pairs: the same contacts in
// the same order for any number of threads.
class Dispatcher final : public btCollisionDispatcher {
 public:
  // The objects' user indices are their blocks. Blocks that fly together are not looked at, nor those far apart that are at
  // home, nor two that do not move.
  Dispatcher(CollisionConfiguration& configuration, Flights& flights, const Homes& homes, const Sleepers& sleepers,
             std::span<const BlockMotion> motions);
  void dispatchAllCollisionPairs(btOverlappingPairCache* cache, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override;

 private:
  struct News {
    int pair;
    std::optional<ContactPoints> contact;  // nothing: its pieces know
  };
  using Motions = std::array<const BlockMotion*, 2>;
  [[nodiscard]] Motions motions_of(const btBroadphasePair& pair) const;
  void claim(const btBroadphasePairArray& pairs, const std::vector<std::vector<News>>& news) const;
  void end_flights(const btBroadphasePairArray& pairs);
  void add_algorithms(btBroadphasePairArray& pairs);
  [[nodiscard]] bool stays_as_it_is(const btBroadphasePair& pair) const;
  // Appends what is new of the pair with this number.
  void look(btBroadphasePair& pair, int number, double time_step, std::vector<News>& news) const;

  Flights& flights_;
  const Homes& homes_;
  const Sleepers& sleepers_;
  std::span<const BlockMotion> motions_;  // of the blocks
};

}  // namespace scree::rigid
