// Where the scene ends: what passes is lost.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::rigid {

// A block is lost when all of it is below the lowest fixed point (against gravity) by more than a tenth of the scene's diagonal
// at the start, or its centre further than ten diagonals from the scene's box at the start, in any direction.
class SceneBounds {
 public:
  SceneBounds(const mesh::BlockMesh<3>& mesh, const Eigen::Vector3d& gravity);

  [[nodiscard]] bool lost(const Eigen::Vector3d& centre, double radius) const;

 private:
  Aabb<3> box_;
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();
  double floor_ = 0;  // height along up_ [m]
};

// Highest point of the free blocks of a placed mesh, `except` those left out, above the highest point of a fixed block that the
// vertical through it meets below it; above the highest fixed point of all below it if that vertical meets nothing. 0 without
// gravity.
double pile_top(const mesh::BlockMesh<3>& placed, const Eigen::Vector3d& gravity, const std::vector<BlockId>& except);

}  // namespace scree::rigid
