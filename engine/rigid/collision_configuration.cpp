#include "engine/rigid/collision_configuration.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>
#include <new>

#include "engine/rigid/compound_collision.h"

namespace scree::rigid {

namespace {

template <class Collision>
class Create final : public btCollisionAlgorithmCreateFunc {
 public:
  Create(const ContactRanges& ranges, HeldContacts& contacts) : ranges_(ranges), contacts_(contacts) {}
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper*,
                                                 const btCollisionObjectWrapper*) override {
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Collision));
    return new (memory) Collision(info, ranges_, contacts_);
  }

 private:
  ContactRanges ranges_;
  HeldContacts& contacts_;
};

btDefaultCollisionConstructionInfo pools(int blocks) {
  btDefaultCollisionConstructionInfo info;
  // The pool takes any size in a release build without asking whether it fits; its elements must be told how large we are.
  info.m_customCollisionAlgorithmMaxElementSize = std::max(sizeof(PolyhedronCollision), sizeof(CompoundCollision));
  info.m_defaultMaxCollisionAlgorithmPoolSize = std::max(4096, 16 * blocks);
  info.m_defaultMaxPersistentManifoldPoolSize = 1;  // none is used (held_contacts.h)
  return info;
}

}  // namespace

CollisionConfiguration::CollisionConfiguration(const ContactRanges& ranges, HeldContacts& contacts, int blocks)
    : btDefaultCollisionConfiguration(pools(blocks)),
      of_polyhedra_(std::make_unique<Create<PolyhedronCollision>>(ranges, contacts)),
      of_compounds_(std::make_unique<Create<CompoundCollision>>(ranges, contacts)) {}

btCollisionAlgorithmCreateFunc* CollisionConfiguration::getCollisionAlgorithmCreateFunc(int first_type, int second_type) {
  const auto ours = [](int type) { return type == CUSTOM_CONVEX_SHAPE_TYPE || type == COMPOUND_SHAPE_PROXYTYPE; };
  if (!ours(first_type) || !ours(second_type)) {
    return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(first_type, second_type);
  }
  return first_type == second_type && first_type == CUSTOM_CONVEX_SHAPE_TYPE ? of_polyhedra_.get() : of_compounds_.get();
}

}  // namespace scree::rigid
