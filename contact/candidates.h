// All touches of semi-springs with faces and of semi-edges with edges, before any is chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/surface.h"

namespace scree::contact {

struct SpringCandidate {
  std::uint32_t spring;  // face * dim + corner
  FaceId target;
  double distance;  // [m]
  double facing;    // cosine, see PointTouch
};

struct EdgeCandidate {
  std::uint32_t semi_edge;  // face * 3 + side
  EdgeId target;
  double distance;    // [m]
  double off_middle;  // of the semi-edge, as a fraction of it
};

struct Candidates {
  std::vector<SpringCandidate> springs;
  std::vector<EdgeCandidate> edges;
};

template <int dim>
Candidates find_candidates(const Surface<dim>& surface, const ContactOptions& options);

}  // namespace scree::contact
