// Where the copies of a shape go.
#pragma once

#include <vector>

#include "engine/mesh/body_spec.h"

namespace scree::mesh {

// The sphere (2-D: circle) that holds a shape in every orientation, about the shape's own origin.
struct Bounds {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // [m]
  double radius = 0;                                 // [m]
};

// One pose per copy; the same body and bounds give the same poses on every machine.
// A lattice runs along x first, then y, then z. Random places are drawn one after the other, each so often until it
// touches none of those before (random sequential addition).
// Throws InputError, with the number that fitted, if the copies of a random arrangement do not fit.
std::vector<Pose> poses_of(const BodySpec& body, const Bounds& bounds, int dimension);

}  // namespace scree::mesh
