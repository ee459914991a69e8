// Which pairs are looked at in a step, and by whom.
#pragma once

#include <array>
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
             std::span<const BlockMotion> motions, std::span<packing::PlacedPiece> placed);
  void dispatchAllCollisionPairs(btOverlappingPairCache* cache, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override;

 private:
  // A pair that has to be looked at.
  struct News {
    int pair;
    bool of_pieces;         // which know what is new
    ContactPoints contact;  // of a pair of polyhedra
  };
  using Motions = std::array<const BlockMotion*, 2>;
  [[nodiscard]] Motions motions_of(const btBroadphasePair& pair) const;
  [[nodiscard]] PolyhedronCollision::Pair sides_of(const btBroadphasePair& pair, double time_step) const;  // of polyhedra
  void claim(const btBroadphasePairArray& pairs) const;
  void end_flights(const btBroadphasePairArray& pairs);
  void add_algorithms(btBroadphasePairArray& pairs);
  [[nodiscard]] bool stays_as_it_is(const btBroadphasePair& pair) const;
  void ask_all(btBroadphasePairArray& pairs, double time_step);
  // Appends the pair with this number if it has to be looked at, and says which blocks are to be placed for it.
  void ask(btBroadphasePair& pair, int number, double time_step, std::vector<News>& news);
  void place_blocks();
  void look(btBroadphasePair& pair, double time_step, News& news) const;

  Flights& flights_;
  const Homes& homes_;
  const Sleepers& sleepers_;
  std::span<const BlockMotion> motions_;  // of the blocks
  std::span<packing::PlacedPiece> placed_;
  std::vector<char> to_place_;
  std::vector<std::vector<News>> news_;  // in the order of the pairs, by parts of them; kept for their memory
};

}  // namespace scree::rigid
