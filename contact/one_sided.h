// Joints of which one side only knows. A semi-spring reaches as far as its own element is large, so across a gap that a coarse
// face reaches over and the finer one does not, the finer side's semi-springs are missing, and with them half of the joint.
#pragma once

#include <optional>

#include "contact/contact_set.h"

namespace scree::contact {

struct OneSided {
  std::size_t contacts = 0;  // semi-springs
  double area = 0;           // of these [m2]
  double tolerance = 0;      // with which the elements that they meet would reach as far [-]
};

// Between blocks of which one has semi-springs that reach the other, and none the other way; of faces that are opposed
// (overlap.h): where they are not, what touches is a corner or an edge, which the other side need not know of. Nothing if they
// are less than a hundredth of the area of all semi-springs that reach a target, as of blocks in a heap that hardly touch.
template <int dim>
std::optional<OneSided> one_sided(const mesh::BlockMesh<dim>& mesh, const ContactSet<dim>& contacts, double tolerance);

}  // namespace scree::contact
