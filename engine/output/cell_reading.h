// The value of a field at a point of a cell as conduction has it (engine/mesh/cells.h): the mean of what both splits give. It
// prefers no diagonal. Where a face is twisted, a split may end short of the point; the nearest of its simplices then counts
// beyond its face.
#pragma once

#include "engine/output/cubic_reading.h"

namespace scree::output {

template <int dim>
Stencil cell_stencil(const mesh::BlockMesh<dim>& mesh, CellId cell, const Point<dim>& point);

}  // namespace scree::output
