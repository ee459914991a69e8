// From a row per node to a row per temperature.
#pragma once

#include "engine/base/material.h"
#include "thermal/heat_model.h"

namespace scree::thermal {

// Takes a model without joints, whose `lumped` says which blocks have one temperature each and whose matrices have empty rows
// for their nodes, to one row for each of them, T' -> P T'. A lumped block starts at the mean of its temperatures, weighted by
// mass; how far they are from it goes into LumpedBlock::start_spread. What acts on its nodes from outside acts on its row, as
// it is at their places.
template <int dim>
void lump(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, HeatModel& model);

}  // namespace scree::thermal
