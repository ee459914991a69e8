// Bullet as it comes: what a program written in a day on it would do, which Scree's settling is compared with.
#pragma once

#include "engine/packing/packing.h"

namespace scree::bench {

struct PlainFall {
  double time = 0;       // simulated, the skipped free fall included [s]
  double rms_speed = 0;  // at the end [m/s]
  packing::Packing<3> packing;
};

constexpr double plain_step = 1.0 / 240;  // [s]

// Lets the convex free blocks fall for `time` seconds in those steps with 20 iterations: double precision, metres, convex
// hulls with a margin of 0.1 mm, and the two things without which nothing of use comes out: lengths that fit the blocks, and
// friction that starts from the last step. The free fall of the lowest block to the highest fixed point is skipped, as Scree
// does.
PlainFall plain_fall(const mesh::BlockMesh<3>& mesh, double density, double friction, double time);

}  // namespace scree::bench
