// What a Cholesky factor of a matrix would hold, by an ordering that takes a tenth of the time of the one it would be made
// with.
#pragma once

#include "thermal/free_nodes.h"
#include "thermal/solver_cost.h"

namespace scree::thermal {

// By approximate minimum degree (AMD; P. R. Amestoy, T. A. Davis, I. S. Duff, SIAM J. Matrix Anal. Appl. 17(4), 1996). Nested
// dissection, which CHOLMOD tries as well, leaves less of solids: at most this. `lower`: the lower triangle.
FactorSize quick_factor_size(const SparseMatrix& lower);

}  // namespace scree::thermal
