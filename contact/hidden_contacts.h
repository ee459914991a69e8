// Overlaps and semi-edges between whose two points another block lies: heat goes through that block, not past it.
//
// Faces are found to overlap across a gap (the tolerance), and a plate may be thinner than it; or the tip of an element that is
// a block of its own, between the floor it lies on and the slanted face of its neighbour. A semi-edge takes the next edge where
// semi-springs join its block to the nearest. Semi-springs take the closest of all and need none of this.
#pragma once

#include "contact/contact_set.h"
#include "contact/find_contacts.h"
#include "contact/surface.h"

namespace scree::contact {

// Takes those overlaps out whose point, seen from either of the two faces along its normal, lies behind a face of a third
// block: across a gap, or deeper within the other than it. Likewise semi-edges, along the way from one point to the other, if
// that is so from the edge they run beside, too. And of either those whose points lie behind each other without one of them
// being in the other's block. Whatever the models of the third block's joints. The surface is that in which the contacts were
// found. Gaps of less than a ten-thousandth of the contact's length, either way, hide nothing, and cost nothing.
template <int dim>
void drop_hidden_contacts(const Surface<dim>& surface, const ContactOptions& options, Contacts<dim>& contacts);

}  // namespace scree::contact
