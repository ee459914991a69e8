// Sums of sparse matrices, by all threads. Eigen 3.4 copies a sparse matrix that is assigned or moved, and the copy is not in
// huge pages: swap it instead.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

// Room for as many entries, in huge pages where it is large; nothing in it is set.
SparseMatrix uninitialised(Eigen::Index size, Eigen::Index entries);

// a + b of square matrices of one size, entry by entry; an entry of either is one of the sum.
SparseMatrix sum_of(const SparseMatrix& a, const SparseMatrix& b);

}  // namespace scree::thermal
