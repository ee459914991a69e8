// Mass, centre and principal axes of a block, exact for its tetrahedra.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::rigid {

struct MassProperties {
  double mass = 0;                                                // [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();               // of mass [m]
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();              // principal, about the centre [kg m2]
  Eigen::Quaterniond principal = Eigen::Quaterniond::Identity();  // from principal axes to the mesh's axes
};

// `density` in kg/m3.
MassProperties mass_properties(const mesh::BlockMesh<3>& mesh, BlockId block, double density);

}  // namespace scree::rigid
