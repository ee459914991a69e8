// From a row per node to a row per temperature.
#pragma once

#include "engine/base/material.h"
#include "thermal/heat_model.h"
#include "thermal/row_numbering.h"

namespace scree::thermal {

// Takes what the model has of each node, and what acts on it, to the rows; its matrices are assembled for them
// (assemble_blocks.h). A lumped block starts at the mean of its temperatures, weighted by mass; how far they are from it goes
// into LumpedBlock::start_spread. Tied nodes start at the mean that keeps their heat. What acts on nodes from outside acts on
// their row, as it is at their places.
template <int dim>
void share_rows(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const RowNumbering& numbering,
                HeatModel& model);

}  // namespace scree::thermal
