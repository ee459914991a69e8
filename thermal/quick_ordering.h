// What a Cholesky factor of a matrix would hold, by an ordering that takes a tenth of the time of the one it would be made
// with.
#pragma once

#include "thermal/free_nodes.h"
#include "thermal/solver_cost.h"

namespace scree::thermal {

// By approximate minimum degree (AMD; P. R. Amestoy, T. A. Davis, I. S. Duff, SIAM J. Matrix Anal. Appl. 17(4), 1996). Nested
// dissection, which CHOLMOD tries as well, leaves less of solids: at most this.
// Of the matrices that implicit steps of the model factorise.
FactorSize quick_factor_size(const HeatModel& model, const FreeNodes& free);

}  // namespace scree::thermal
