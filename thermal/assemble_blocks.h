// The matrices of the blocks, eqs. (4), (5) and (7), row by row: what a mesh of ten million elements needs is the matrix and a
// list of its simplices, no list of entries. Rows are independent, so threads share them without a change of any bit; an entry
// and its mirror image are summed in the same order, so K is symmetric to the bit.
#pragma once

#include <optional>

#include "thermal/heat_model.h"
#include "thermal/row_numbering.h"

namespace scree::thermal {

// Fills in the capacities (and masses, if they vary) of the model, which has its initial temperatures; returns K of the
// blocks with a constant conductivity, and sets U of the others where there are any, and B in fourth order.
// Matrices have the rows that are numbered: P^T K P where T = P T'; those of lumped blocks stay empty. The rest is of nodes.
template <int dim>
SparseMatrix assemble_blocks(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, SpaceOrder order,
                             const std::optional<RowNumbering>& numbering, HeatModel& model);

}  // namespace scree::thermal
