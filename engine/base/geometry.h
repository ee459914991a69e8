// Points, boxes and poses.
#pragma once

#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scree {

template <int dim>
using Point = Eigen::Matrix<double, dim, 1>;  // [m]

template <int dim>
using Aabb = Eigen::AlignedBox<double, dim>;  // [m]

// Where a block is: world = rotation * reference + translation. A scene in 2-D uses x and y only.
struct Pose {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& reference) const { return rotation * reference + translation; }
};

inline Pose inverse(const Pose& pose) {
  const Eigen::Quaterniond back = pose.rotation.conjugate();
  return {back * -pose.translation, back};
}

inline Pose operator*(const Pose& outer, const Pose& inner) {
  return {outer * inner.translation, (outer.rotation * inner.rotation).normalized()};
}

}  // namespace scree
