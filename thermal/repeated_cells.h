// Cells that are one another moved along: a grid has one shape for all its cells, which is worked out once.
//
// Two cells count as the same if their edges, rounded to 2^-36 of the cell's size (1.5e-11 of it), are; the rounded edges are
// what is worked out, so that equal cells have the same conductances to the bit, which repeats rows of K (row_runs.h). A cell
// that is like no other is left as it is.
#pragma once

#include <cstdint>
#include <vector>

#include "thermal/cell_conduction.h"

namespace scree::thermal {

template <int dim>
class RepeatedCells {
 public:
  using Corners = std::array<CornerOfCell, 8>;

  // `conductivity` of each block [W/m/K].
  RepeatedCells(const mesh::BlockMesh<dim>& mesh, const Table<BlockId, Tensor<dim>>& conductivity,
                SpaceOrder order = SpaceOrder::second);

  // What the corners of the cell have of it; nothing if no other cell is the same, or there are too many to keep.
  [[nodiscard]] const Corners* find(CellId cell) const { return which_[cell] < 0 ? nullptr : &shapes_[which_[cell]]; }

 private:
  Table<CellId, std::int32_t> which_;  // of shapes_, or -1
  std::vector<Corners> shapes_;
};

}  // namespace scree::thermal
