#include "engine/rigid/homes.h"

#include <cmath>
#include <limits>

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace scree::rigid {

namespace {

btTransform nowhere() {
  return btTransform(btMatrix3x3::getIdentity(), btVector3(std::numeric_limits<double>::infinity(), 0, 0));
}

}  // namespace

double way_moved(const btTransform& from, const btTransform& to, double radius) {
  double turned = 0;
  for (int i = 0; i < 3; ++i) turned += (from.getBasis()[i] - to.getBasis()[i]).length2();
  return (from.getOrigin() - to.getOrigin()).length() + radius * std::sqrt(turned);
}

Homes::Homes(std::size_t blocks, double range) : range_(range), at_home_(blocks, 1), homes_(blocks, nowhere()) {}

void Homes::look(const btRigidBody& body, double radius, double time_step) {
  const int block = body.getUserIndex();
  const double way = (body.getLinearVelocity().length() + radius * body.getAngularVelocity().length()) * time_step;
  const bool here = way < range_ && way_moved(homes_[block], body.getWorldTransform(), radius) < range_;
  at_home_[block] = here ? 1 : 0;
  if (!here) homes_[block] = body.getWorldTransform();
}

}  // namespace scree::rigid
