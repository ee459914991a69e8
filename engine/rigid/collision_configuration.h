// Which algorithm Bullet takes for which two shapes.
#pragma once

#include <memory>

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

#include "engine/rigid/polyhedron_collision.h"

namespace scree::rigid {

// Ours for polyhedra and blocks of several; there are no others in our worlds.
class CollisionConfiguration final : public btDefaultCollisionConfiguration {
 public:
  CollisionConfiguration(const ContactRanges& ranges, HeldContacts& contacts, int blocks);
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int first_type, int second_type) override;

 private:
  std::unique_ptr<btCollisionAlgorithmCreateFunc> of_polyhedra_, of_compounds_;
};

}  // namespace scree::rigid
