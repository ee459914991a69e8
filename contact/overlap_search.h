// Every pair of boundary faces of two blocks that lie on each other, once.
#pragma once

#include <vector>

#include "contact/find_contacts.h"
#include "contact/surface.h"

namespace scree::contact {

// One contact for each quadrature point of the pairs of bodies that are modelled by their overlap; pairs of faces come in
// ascending order.
//
// Faces lie on each other where they are opposed (overlap.h) and the gap is at most `tolerance` characteristic lengths of the
// smaller of the two elements, so that a face does not reach through a block that is thin for it.
template <int dim>
Contacts<dim> overlap_contacts(const Surface<dim>& surface, const ContactOptions& options);

}  // namespace scree::contact
