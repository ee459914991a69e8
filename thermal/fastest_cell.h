// How fast a grid of equal cells can be, by its cells one by one: no eigenvalue of matrices that are sums over cells is larger
// than the largest of any cell's own (I. Fried, J. Sound Vib. 22(4), 1972). In a grid of equal boxes the fastest mode turns its
// sign from corner to corner in every cell, so this bound is exact there, and sums of magnitudes (stable_step.h) are not.
#pragma once

#include <optional>

#include "thermal/heat_model.h"
#include "thermal/repeated_cells.h"

namespace scree::thermal {

// Nothing unless all that conducts are cells that repeat, with properties that do not change.
template <int dim>
std::optional<FastestCell> fastest_cell(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                        const RepeatedCells<dim>& repeated, const HeatModel& model);

}  // namespace scree::thermal
