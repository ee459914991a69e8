// Which target each semi-spring and semi-edge takes.
#pragma once

#include <vector>

#include "contact/edge_search.h"
#include "contact/find_contacts.h"
#include "contact/spring_search.h"
#include "contact/surface.h"

namespace scree::contact {

template <int dim>
struct Targets {
  SpringTargets<dim> of_springs;
  std::vector<TakenEdge> of_edges;  // of the semi-edges that have a target, in their order; empty in 2-D
};

// Each takes the closest face (edge) of all other blocks that it touches. Equally close faces: the one that looks at it most
// directly; equally close edges: the one that crosses nearest to the middle; then the lowest id. A semi-edge has a target only
// where semi-springs have missed the contact: none of the two faces at its edge and none of the two at the target edge may have
// a semi-spring that touches the other block.
template <int dim>
Targets<dim> find_targets(const Surface<dim>& surface, const ContactOptions& options);

}  // namespace scree::contact
