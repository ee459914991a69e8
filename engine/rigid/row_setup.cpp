#include "engine/rigid/row_setup.h"

#include <algorithm>
#include <cmath>

#include "engine/rigid/free_rotation.h"
#include "engine/rigid/polyhedron_shape.h"

namespace scree::rigid {

namespace {

using Bodies = std::array<const BodyStart*, 2>;
using Arms = std::array<Eigen::Vector3d, 2>;  // from the centres to the point

// One that asks for an end of the motion along `direction` and for `more` on top of that.
void set_up_along(Row& row, const Eigen::Vector3d& direction, const Bodies& bodies, const Arms& arms, double more) {
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
}

// The speed at which the point is to part by its restitution, by the velocities before the step.
double rebound(const HeldPoint& point, const Eigen::Vector3d& normal, const Bodies& bodies, const Arms& arms,
               double bounce_speed) {
  if (point.restitution <= 0) return 0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (int i = 0; i < 2; ++i) {
    if (bodies[i] == nullptr) continue;
    const Eigen::Vector3d at = from_bullet(bodies[i]->body->getVelocityInLocalPoint(to_bullet(arms[i])));
    velocity += i == 0 ? at : Eigen::Vector3d(-at);
  }
  const double approach = -velocity.dot(normal);
  return approach < bounce_speed ? 0.0 : point.restitution * approach;
}

}  // namespace

BodyStart start_of(const btRigidBody& body, double time_step) {
  BodyStart start;
  start.body = &body;
  start.centre = from_bullet(body.getCenterOfMassPosition());
  start.inverse_mass = body.getInvMass();
  start.inverse_inertia = from_bullet(body.getInvInertiaTensorWorld());
  start.linear = from_bullet(body.getLinearVelocity() + body.getGravity() * time_step);
  const FreeRotation rotation = free_rotation(body, time_step);
  start.angular = rotation.mean;
  start.momentum = rotation.momentum;
  return start;
}

BodyStart start_asleep(const btRigidBody& body) {
  BodyStart start;
  start.centre = from_bullet(body.getCenterOfMassPosition());
  return start;
}

PlacedContact place(HeldContact& contact, const btTransform& first, const btTransform& second) {
  const btVector3 normal = first.getBasis() * to_bullet(contact.normal),
                  tangent = first.getBasis() * to_bullet(contact.tangent);
  PlacedContact placed;
  placed.axes = {from_bullet(normal), from_bullet(tangent), from_bullet(normal.cross(tangent))};
  for (int i = 0; i < contact.count; ++i) {
    HeldPoint& point = contact.points[i];
    const btVector3 on_first = first(to_bullet(point.on_first)), on_second = second(to_bullet(point.on_second));
    placed.points[i] = {from_bullet(on_first), from_bullet(on_second)};
    if (!contact.fresh) point.distance = normal.dot(on_first - on_second);
  }
  contact.fresh = false;
  return placed;
}

double set_up_row(ContactRow& row, const HeldContact& contact, const PlacedContact& placed, int number, const Bodies& bodies,
                  const StepLengths& step) {
  const HeldPoint& point = contact.points[number];
  Arms arms{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  if (bodies[0] != nullptr) arms[0] = placed.points[number].on_first - bodies[0]->centre;
  if (bodies[1] != nullptr) arms[1] = placed.points[number].on_second - bodies[1]->centre;
  // A pair apart may close its gap within the step.
  const double gap = std::max(point.distance - step.clearance, 0.0) / step.time_step;
  const Eigen::Vector3d& normal = placed.axes[0];
  const double parting = rebound(point, normal, bodies, arms, step.bounce_speed);
  set_up_along(row.normal, normal, bodies, arms, parting - gap);
  for (int i = 0; i < 2; ++i) set_up_along(row.friction[i], placed.axes[i + 1], bodies, arms, 0);
  row.coefficient = contact.friction;
  row.normal.applied = point.impulses[0];
  // Turned into new directions it may be a hair more.
  const double most = row.coefficient * point.impulses[0];
  const double size = std::hypot(point.impulses[1], point.impulses[2]);
  const double part = size > most ? most / size : 1;
  for (int i = 0; i < 2; ++i) row.friction[i].applied = part * point.impulses[i + 1];
  return parting * row.normal.scale;
}

double overlap_impulse(const HeldPoint& point, const Row& normal, const StepLengths& step) {
  return std::max(step.clearance - point.distance, 0.0) * step.erp / step.time_step * normal.scale;
}

}  // namespace scree::rigid
