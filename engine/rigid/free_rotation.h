// How a body turns by itself within a step, and is moved by a step.
//
// The angular momentum of a body on which nothing acts stays, and so does its energy; where its moments of inertia are unlike,
// its angular velocity does not (Euler's equations). Bullet's implicit step of them loses both, and gives nothing at all for
// small blocks: it takes a determinant of inertias below 2e-16 (kg m2)^3 for zero, that of stones of 3 cm.
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <Eigen/Core>

namespace scree::rigid {

struct FreeRotation {
  Eigen::Vector3d mean;      // the constant angular velocity that turns the body by as much as the step does [1/s]
  Eigen::Vector3d momentum;  // angular, about the centre [kg m2/s]
};

// Of a body with its present velocity. By turns about principal axes one after the other, each of which is exact (A. Dullweber,
// B. Leimkuhler and R. McLachlan, J. Chem. Phys. 107, 1997): of second order, exact if two moments are equal; the momentum is
// kept to rounding, and the energy swings about its value.
FreeRotation free_rotation(const btRigidBody& body, double time_step);

// Where contacts change the momentum within a step, the free turn of before and the change are added to each other, which is no
// turn of the new momentum: of a needle that spins about its length, tilted by a degree too far, a little of the momentum that
// lies along it is much energy. Of such a body the turn is worked out again from the new momentum.
bool is_needle(const btRigidBody& body);

// The angular momentum that a change of the angular velocity adds, where the body is now [kg m2/s].
Eigen::Vector3d momentum_of(const btRigidBody& body, const Eigen::Vector3d& angular);

// Where constant velocities take a pose, exactly for any angle.
btTransform moved(const btTransform& pose, const btVector3& velocity, const btVector3& angular, double time);

}  // namespace scree::rigid
