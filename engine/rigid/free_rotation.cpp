#include "engine/rigid/free_rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

constexpr double most_turned = 0.2;     // in one round of turns [rad]
constexpr int most_rounds = 64;         // of a step
constexpr double needle = 10;           // the largest moment over the least, and more
constexpr double little_turned = 1e-3;  // in a step, of which the tangent is as good as the turns [rad]

Eigen::Vector3d principal_moments(const btRigidBody& body) {
  return from_bullet(body.getLocalInertia());
}

Eigen::Quaterniond turn_by(const Eigen::Vector3d& vector) {
  const double half = 0.5 * vector.norm();
  const double factor = half < 1e-4 ? 0.5 - half * half / 12 : 0.5 * std::sin(half) / half;
  return {std::cos(half), factor * vector.x(), factor * vector.y(), factor * vector.z()};
}

// About principal axis k: the body turns, and a momentum that stays in space turns the other way within it.
void turn_about(int k, double angle, Eigen::Vector3d& momentum, Eigen::Quaterniond& turned) {
  const double c = std::cos(angle), s = std::sin(angle);
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double along = momentum[i];
  momentum[i] = c * along + s * momentum[j];
  momentum[j] = c * momentum[j] - s * along;
  turned = turned * turn_by(angle * Eigen::Vector3d::Unit(k));
}

// The angular velocity of a turn that is done in a time: of all that end alike the one nearest to `about`.
Eigen::Vector3d rate_of(const Eigen::Quaterniond& turned, double time, const Eigen::Vector3d& about) {
  const double half = std::atan2(turned.vec().norm(), turned.w());
  if (half == 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d axis = turned.vec().normalized();
  const double full = 2 * std::numbers::pi;
  const double rounds = std::round((axis.dot(about) * time - 2 * half) / full);
  return (2 * half + rounds * full) / time * axis;
}

// The energy is that of a sphere with the middle moment, whose turn about the momentum goes with any other, and what the other
// two axes have more or less. So bodies with two equal moments turn exactly.
Eigen::Vector3d mean_of_turns(const Eigen::Vector3d& moments, const Eigen::Vector3d& spin, double time_step) {
  std::array<int, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return moments[a] < moments[b]; });
  const auto [low, middle, high] = axes;
  const double of_low = 1 / moments[low] - 1 / moments[middle], of_high = 1 / moments[high] - 1 / moments[middle];
  Eigen::Vector3d momentum = moments.cwiseProduct(spin);
  const double fastest = momentum.norm() * (of_low - of_high);
  const auto rounds = static_cast<int>(std::clamp<double>(std::ceil(fastest * time_step / most_turned), 1, most_rounds));
  const double time = time_step / rounds;
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  for (int round = 0; round < rounds; ++round) {
    turn_about(low, 0.5 * time * of_low * momentum[low], momentum, turned);
    turn_about(high, time * of_high * momentum[high], momentum, turned);
    turn_about(low, 0.5 * time * of_low * momentum[low], momentum, turned);
  }
  turned = turned * turn_by(time_step / moments[middle] * momentum);
  return rate_of(turned, time_step, spin);
}

}  // namespace

FreeRotation free_rotation(const btRigidBody& body, double time_step) {
  const Eigen::Matrix3d axes = from_bullet(body.getWorldTransform().getBasis());
  const Eigen::Vector3d moments = principal_moments(body);
  const Eigen::Vector3d spin = axes.transpose() * from_bullet(body.getAngularVelocity());
  const Eigen::Vector3d momentum = moments.cwiseProduct(spin);
  const bool slow = spin.squaredNorm() * time_step * time_step < little_turned * little_turned;
  const Eigen::Vector3d mean = slow ? Eigen::Vector3d(spin + 0.5 * time_step * momentum.cross(spin).cwiseQuotient(moments))
                                    : mean_of_turns(moments, spin, time_step);
  return {axes * mean, axes * momentum};
}

bool is_needle(const btRigidBody& body) {
  const Eigen::Vector3d moments = principal_moments(body);
  return moments.maxCoeff() > needle * moments.minCoeff();
}

Eigen::Vector3d momentum_of(const btRigidBody& body, const Eigen::Vector3d& angular) {
  const Eigen::Matrix3d axes = from_bullet(body.getWorldTransform().getBasis());
  return axes * principal_moments(body).cwiseProduct(axes.transpose() * angular);
}

btTransform moved(const btTransform& pose, const btVector3& velocity, const btVector3& angular, double time) {
  const Eigen::Quaterniond turn = turn_by(time * from_bullet(angular));
  btQuaternion orientation = btQuaternion(turn.x(), turn.y(), turn.z(), turn.w()) * pose.getRotation();
  orientation.normalize();
  return btTransform(orientation, pose.getOrigin() + velocity * time);
}

}  // namespace scree::rigid
