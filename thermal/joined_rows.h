// Which rows of a model heat passes between.
#pragma once

#include "engine/mesh/disjoint_sets.h"
#include "thermal/heat_model.h"

namespace scree::thermal {

// Puts rows that a matrix of conductances couples into one group.
inline void join_rows(const SparseMatrix& conductance, mesh::DisjointSets& groups) {
  for (int column = 0; column < conductance.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(conductance, column); entry; ++entry) {
      if (entry.value() != 0) groups.join(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(column));
    }
  }
}

}  // namespace scree::thermal
