// Faces of two blocks with the same corners: nearly all there are where a body is cut into blocks that have not moved.
#pragma once

#include "contact/spring_search.h"

namespace scree::contact {

// The semi-springs of two such faces take each the other's face, to which their distance is 0; they need no search. The corners
// must agree to the bit, the faces look against each other, and no third one have these corners. Tells whether there are any:
// where a sample finds few, none is looked for.
template <int dim>
bool take_twins(const Surface<dim>& surface, const ContactOptions& options, SpringTargets<dim>& targets);

}  // namespace scree::contact
