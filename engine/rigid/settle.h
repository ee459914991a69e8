// Drop and settle: rigid blocks fall under gravity and come to rest.
#pragma once

#include <functional>

#include "engine/base/material.h"
#include "engine/packing/packing.h"

namespace scree::rigid {

struct SettleOptions {
  Eigen::Vector3d gravity{0, 0, -9.81};  // [m/s2]
  double limit = 10;                     // longest simulated time [s]
  double step = 1.0 / 240;               // [s]
  double local_damping = 0;              // Cundall's local damping factor [-], in [0, 1)
  // Drag, per mass [1/s]: a block falls no faster than gravity over this. It is taken away once all blocks were let go and
  // their root mean square speed is a fiftieth of that, though not before it had the time to act, 1/c, so the pile comes to
  // rest without it, and in half steps: slopes at their limit shed block after block on coarser ones. At most 1 / step.
  double viscous_damping = 0;
  // Blocks are let go one by one, evenly over this time [s], from the lower rim of the load to the middle of its top: in the
  // order of height less distance from the vertical through its centre of mass. The others hang where they were meshed, and
  // touch nothing, until it is their turn. 0 lets all of them go at once.
  double release_time = 0;
  double rest_speed = 1e-3;             // root mean square speed below which a pile may be at rest [m/s]
  double rest_unbalanced_force = 0.05;  // largest accepted unbalanced force [-]
  double rest_displacement = 0.01;      // largest accepted way of any block in a window, over the mean edge or its width [-]
  double rest_window = 0.25;            // all three must hold for this long [s]
  // Blocks come to rest this far apart [m]: above what is left of overlaps, no two of them overlap. 0: they touch.
  double clearance = 0;
  // Of the contact solver in each step. Too few, and a stack sways on it: five cubes need 80. A pile of thousands of small
  // blocks does with 20 (README.md).
  int iterations = 80;
  double frame_interval = 0.02;  // between frames given to the sink [s]
};

// Receives the poses as the pile falls: simulated time [s], one pose per block.
using FrameSink = std::function<void(double time, const Table<BlockId, Pose>& poses)>;
// Told now and then how far the stage is: simulated time [s], rms speed [m/s]. May throw to stop.
using SettleProgress = std::function<void(double time, double rms_speed)>;

// Lets the blocks of free bodies fall until they are at rest or `limit` is reached, which the report tells.
// The same input gives the same poses, to the bit, on the same machine and binary.
packing::Packing<3> settle(const mesh::BlockMesh<3>& blocks, const Table<MaterialId, Material>& materials,
                           const SettleOptions& options, const FrameSink& frame = {}, const SettleProgress& progress = {});

}  // namespace scree::rigid
