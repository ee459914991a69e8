#include "engine/rigid/row_setup.h"

#include <algorithm>
#include <cmath>

#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

using Bodies = std::array<const BodyStart*, 2>;
using Arms = std::array<Eigen::Vector3d, 2>;  // from the centres to the point

Eigen::Matrix3d matrix_of(const btMatrix3x3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) result.row(i) = from_bullet(m[i]).transpose();
  return result;
}

// One that asks for an end of the motion along `direction` and for `more` on top of that.
Row row_along(const Eigen::Vector3d& direction, const Bodies& bodies, const Arms& arms, double more) {
  Row row;
  row.direction = direction;
  double compliance = 0;
  double approach = 0;
  for (int i = 0; i < 2; ++i) {
    row.moment[i].setZero();
    row.turn[i].setZero();
    if (bodies[i] == nullptr) continue;
    const BodyStart& body = *bodies[i];
    const double sign = i == 0 ? 1 : -1;
    row.moment[i] = sign * arms[i].cross(direction);
    row.turn[i] = body.inverse_inertia * row.moment[i];
    compliance += body.inverse_mass + row.moment[i].dot(row.turn[i]);
    approach += sign * direction.dot(body.linear) + row.moment[i].dot(body.angular);
  }
  row.scale = 1 / compliance;
  row.wanted = (more - approach) * row.scale;
  return row;
}

// The speed at which the point is to part by its restitution, by the velocities before the step.
double rebound(const btManifoldPoint& point, const Bodies& bodies, const Arms& arms, double bounce_speed) {
  if (point.m_combinedRestitution <= 0) return 0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (int i = 0; i < 2; ++i) {
    if (bodies[i] == nullptr) continue;
    const Eigen::Vector3d at = from_bullet(bodies[i]->body->getVelocityInLocalPoint(to_bullet(arms[i])));
    velocity += i == 0 ? at : Eigen::Vector3d(-at);
  }
  const double approach = -velocity.dot(from_bullet(point.m_normalWorldOnB));
  return approach < bounce_speed ? 0.0 : point.m_combinedRestitution * approach;
}

}  // namespace

BodyStart start_of(const btRigidBody& body, double time_step) {
  BodyStart start;
  start.body = &body;
  start.centre = from_bullet(body.getCenterOfMassPosition());
  start.inverse_mass = body.getInvMass();
  start.inverse_inertia = matrix_of(body.getInvInertiaTensorWorld());
  start.linear = from_bullet(body.getLinearVelocity() + body.getGravity() * time_step);
  start.angular = from_bullet(body.getAngularVelocity() + body.computeGyroscopicImpulseImplicit_Body(time_step));
  return start;
}

BodyStart start_asleep(const btRigidBody& body) {
  BodyStart start;
  start.centre = from_bullet(body.getCenterOfMassPosition());
  return start;
}

ContactRow contact_row(const btManifoldPoint& point, const Bodies& bodies, std::array<int, 2> ids, const StepLengths& step) {
  Arms arms{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  if (bodies[0] != nullptr) arms[0] = from_bullet(point.m_positionWorldOnA) - bodies[0]->centre;
  if (bodies[1] != nullptr) arms[1] = from_bullet(point.m_positionWorldOnB) - bodies[1]->centre;
  // A pair apart may close its gap within the step.
  const double gap = std::max(point.m_distance1 - step.clearance, 0.0) / step.time_step;
  ContactRow row;
  row.normal =
      row_along(from_bullet(point.m_normalWorldOnB), bodies, arms, rebound(point, bodies, arms, step.bounce_speed) - gap);
  row.friction[0] = row_along(from_bullet(point.m_lateralFrictionDir1), bodies, arms, 0);
  row.friction[1] = row_along(from_bullet(point.m_lateralFrictionDir2), bodies, arms, 0);
  row.coefficient = point.m_combinedFriction;
  row.bodies = ids;
  row.normal.applied = point.m_appliedImpulse;
  // Turned into new directions it may be a hair more.
  const double most = row.coefficient * point.m_appliedImpulse;
  const double size = std::hypot(point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2);
  const double part = size > most ? most / size : 1;
  row.friction[0].applied = part * point.m_appliedImpulseLateral1;
  row.friction[1].applied = part * point.m_appliedImpulseLateral2;
  return row;
}

double overlap_impulse(const btManifoldPoint& point, const Row& normal, const StepLengths& step) {
  return std::max(step.clearance - point.m_distance1, 0.0) * step.erp / step.time_step * normal.scale;
}

}  // namespace scree::rigid
