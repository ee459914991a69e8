// From a row per node to a row per temperature.
#pragma once

#include <optional>

#include "engine/base/material.h"
#include "thermal/heat_model.h"

namespace scree::thermal {

// Takes a model without joints to fewer rows, T = P T': one for all nodes of a lumped block (`lumped` of the model, whose
// matrices have empty rows for them), and one for the nodes that are one (`tied`, tied_nodes.h; not where properties depend on
// temperature). A lumped block starts at the mean of its temperatures, weighted by mass; how far they are from it goes into
// LumpedBlock::start_spread. Tied nodes start at the mean that keeps their heat. What acts on nodes from outside acts on their
// row, as it is at their places.
template <int dim>
void share_rows(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                const std::optional<Table<NodeId, NodeId>>& tied, HeatModel& model);

}  // namespace scree::thermal
