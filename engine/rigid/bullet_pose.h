// Poses as Bullet has them.
#pragma once

#include <LinearMath/btTransform.h>

#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

inline btTransform transform_of(const Pose& pose) {
  const auto& q = pose.rotation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.translation));
}

inline Pose pose_of(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {from_bullet(transform.getOrigin()), Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized()};
}

}  // namespace scree::rigid
