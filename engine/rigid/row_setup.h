// A contact point between two bodies as rows of the solver.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "engine/rigid/block_motion.h"
#include "engine/rigid/contact_rows.h"
#include "engine/rigid/held_contacts.h"

namespace scree::rigid {

// A body as it enters a step.
struct BodyStart {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // [m]
  // With what gravity adds in the step, and the mean over the step of what the body turns by itself [m/s], [1/s].
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();         // angular, about the centre [kg m2/s]
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  // world axes [1/(kg m2)]
  double inverse_mass = 0;                                    // [1/kg]
  const btRigidBody* body = nullptr;
};

struct StepLengths {
  double time_step = 0;     // [s]
  double erp = 0;           // part of an overlap that a step undoes [-]
  double bounce_speed = 0;  // an approach slower than this has no restitution [m/s]
  double clearance = 0;     // at which two blocks touch [m]
};

BodyStart start_of(const btRigidBody& body, double time_step);
BodyStart start_asleep(const btRigidBody& body);  // nothing moves it

// A contact where its blocks are now.
struct PlacedContact {
  std::array<Eigen::Vector3d, 3> axes;  // the normal and the directions of friction
  struct Point {
    Eigen::Vector3d on_first, on_second;  // [m]
  };
  std::array<Point, 4> points;
};

// The distances of the contact follow its points, exactly so for a pair that does not turn.
PlacedContact place(HeldContact& contact, const btTransform& first, const btTransform& second);

// The rows of a point, starting from the impulses of the last step; null: a fixed body. The row knows already whom it concerns.
// Returns the part of what its normal row wants that is its rebound.
double set_up_row(ContactRow& row, const HeldContact& contact, const PlacedContact& placed, int point,
                  const std::array<const BodyStart*, 2>& bodies, const StepLengths& step);

// The impulse that would undo the overlap of the point by itself, or bring it to the clearance; zero if it is further apart.
double overlap_impulse(const HeldPoint& point, const Row& normal, const StepLengths& step);

}  // namespace scree::rigid
