// The one entry point of the contact room.
#pragma once

#include "contact/contact_set.h"

namespace scree::contact {

struct ContactOptions {
  double indentation = 0.05;  // way from the vertex to the centre of its face, in (0, 1); the paper uses 0.01 to 0.05
  double tolerance =
      0.01;  // largest gap or depth, of the semi-spring or its vertex, in characteristic lengths of the owner's element
};

// Semi-springs and semi-edges of every block against the target faces and target edges of all other blocks (Li & Feng 2016,
// section 1.4). Coarse search by cells of space, linear in the number of faces; exact per face and edge.
template <int dim>
ContactSet<dim> find_contacts(const mesh::BlockMesh<dim>& mesh, const ContactOptions& options);

}  // namespace scree::contact
