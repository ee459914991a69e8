// Our narrow phase in Bullet's collision configuration: separating axes and face clipping on the true geometry, no margin.
#pragma once

#include <memory>

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

#include "engine/packing/separation.h"
#include "engine/rigid/flights.h"
#include "engine/rigid/homes.h"

namespace scree::rigid {

// Lengths of the contact search; the world derives them from the size of the blocks.
struct ContactRanges {
  double near = 0;          // points nearer than this, plus what the pair may approach in a step, become contacts [m]
  double face_bias = 0;     // see packing::separation [m]
  double still = 0;         // a pair that moved less than this since its points were computed keeps them [m]
  double bounce_speed = 0;  // an approach slower than this has no restitution [m/s]
  double home = 0;          // range of Homes [m]
  double clearance = 0;     // at which two blocks touch [m]
};

// Creates the algorithm for two polyhedra and leaves other shapes (compounds) to Bullet.
class CollisionConfiguration final : public btDefaultCollisionConfiguration {
 public:
  CollisionConfiguration(const ContactRanges& ranges, int blocks);
  ~CollisionConfiguration() override;
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int first_type, int second_type) override;

 private:
  std::unique_ptr<btCollisionAlgorithmCreateFunc> create_;
};

// Looks at the pairs of polyhedra on all threads, then takes over what is new in the order of the pairs: the same contacts in
// the same order for any number of threads.
class Dispatcher final : public btCollisionDispatcher {
 public:
  // The objects' user indices are their blocks. Blocks that fly together are not looked at, nor those far apart that are at
  // home.
  Dispatcher(CollisionConfiguration& configuration, Flights& flights, const Homes& homes);
  void dispatchAllCollisionPairs(btOverlappingPairCache* cache, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override;

 private:
  void end_flights(btOverlappingPairCache& cache);
  void add_algorithm(btBroadphasePair& pair);

  Flights& flights_;
  const Homes& homes_;
};

}  // namespace scree::rigid
