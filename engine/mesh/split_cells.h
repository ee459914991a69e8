// Cells of a file or a shape to simplices.
#pragma once

#include "engine/mesh/body_spec.h"
#include "engine/mesh/raw_mesh.h"

namespace scree::mesh {

// Leaves the cells that fill this dimension in `raw.cells` and adds their splits by the smallest node to its triangles (2-D) or
// tetrahedra; does nothing if there are no cells. Quadrilaterals in 3-D are taken for faces of the cells. Wedges may have
// either orientation, since programs differ, and are turned. Throws InputError for cells beside simplices, cells of a higher
// dimension, a quadrilateral that belongs to no cell, and a cell that is inside out or too distorted: one with a simplex in its
// splits whose volume is not positive.
template <int dim>
void split_cells(const BodySpec& body, RawMesh& raw);

}  // namespace scree::mesh
