// What the series show: the arrays of blocks, of temperatures and of contacts.
#pragma once

#include <vector>

#include "contact/contact_set.h"
#include "engine/output/series.h"
#include "engine/packing/packing.h"

namespace scree::run {

// `block`, `body` and `material` of every cell of output::make_grid: counted from 0 in the order of the scene. `numbers` are
// those of the mesh's blocks there.
template <int dim>
std::vector<output::Array> identity_arrays(const mesh::BlockMesh<dim>& mesh, const Table<BlockId, BlockId>& numbers);

// Blocks on their way: grid of the mesh with every block at its pose.
output::Grid grid_at(const mesh::BlockMesh<3>& mesh, const Table<BlockId, Pose>& poses);

// `temperature` [K] at the nodes and `heat_flux` [W/m2] in the cells.
template <int dim>
output::Frame heat_frame(double time, const Eigen::VectorXd& temperature, const std::vector<Point<dim>>& flux);

// The largest value among the elements of each cell that a series shows.
template <int dim>
std::vector<double> largest_in_cells(const mesh::BlockMesh<dim>& mesh, const std::vector<double>& of_element);

// One vertex per contact, where it is.
template <int dim>
output::Grid contact_grid(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts);

// `area` [m2], `gap` [m], `kind` (0 point-face, 1 edge-edge, 2 overlap), `owner` and `target` (blocks, by their
// `numbers`).
template <int dim>
std::vector<output::Array> contact_arrays(const contact::ContactSet<dim>& contacts, const Table<BlockId, BlockId>& numbers);

}  // namespace scree::run
