// How far contacts are looked for, and what is too little to look at.
#pragma once

#include "engine/mesh/block_mesh.h"
#include "engine/rigid/settle.h"

namespace scree::rigid {

// Lengths of the contact search; the world derives them from the size of the blocks.
struct ContactRanges {
  double near = 0;          // points nearer than this, plus what the pair may approach in a step, become contacts [m]
  double face_bias = 0;     // see packing::separation [m]
  double still = 0;         // a pair that moved less than this since its points were computed keeps them [m]
  double bounce_speed = 0;  // an approach slower than this has no restitution [m/s]
  double home = 0;          // range of Homes [m]
  double clearance = 0;     // at which two blocks touch [m]
  double fall = 0;          // what gravity adds to a block's way within a step [m]
};

// Cube root of its volume [m].
double size_of(const mesh::BlockMesh<3>& mesh, const mesh::Block& block);

// In proportion to the mean size of the free blocks.
ContactRanges ranges_for(const mesh::BlockMesh<3>& mesh, const SettleOptions& options);

}  // namespace scree::rigid
