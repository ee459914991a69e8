// Heat fluxes inside blocks, as frames show them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "engine/base/material.h"
#include "engine/mesh/block_mesh.h"

namespace scree::thermal {

// Heat flux of each cell as a series shows them, block by block: its cells, or its elements if it has none [W/m2].
template <int dim>
std::vector<Point<dim>> cell_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                    const Eigen::VectorXd& temperature);

// Heat flux of each element, eq. (4) [W/m2].
template <int dim>
std::vector<Point<dim>> element_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                       const Eigen::VectorXd& temperature);

}  // namespace scree::thermal
