// Every pair of boundary faces of two blocks that lie on each other, once.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/overlap.h"
#include "contact/surface.h"

namespace scree::contact {

// Is told the faces (first < second) and their overlap; pairs come in ascending order.
template <int dim>
using VisitOverlap = std::function<void(FaceId first, FaceId second, const std::vector<OverlapPoint<dim>>&)>;

// Says for which pairs of bodies to look.
using Wanted = std::function<bool(BodyId, BodyId)>;

// Faces lie on each other where they are opposed (overlap.h) and the gap is at most `tolerance` characteristic lengths of the
// smaller of the two elements, so that a face does not reach through a block that is thin for it.
template <int dim>
void visit_overlaps(const Surface<dim>& surface, double tolerance, const Wanted& wanted, const VisitOverlap<dim>& visit);

// One contact for each quadrature point of the pairs of bodies that are modelled by their overlap.
template <int dim>
std::vector<Contact<dim>> overlap_contacts(const Surface<dim>& surface, const ContactOptions& options);

}  // namespace scree::contact
