// Which target edge each semi-edge takes, where semi-springs have missed the contact. 3-D only.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/choice.h"
#include "contact/edge_pairs.h"
#include "contact/find_contacts.h"
#include "contact/near_shells.h"
#include "contact/touch.h"

namespace scree::contact {

// A semi-edge that touches, the target it takes, and how.
struct TakenEdge {
  std::uint32_t semi_edge;  // of side s of face f: f * 3 + s
  EdgeId target;
  EdgeTouch touch;
};

// Two shells and those of their edges that may touch.
struct NearEdges {
  std::uint32_t first;  // places
  std::uint32_t second;
  EdgePairs edges;
};

class EdgeSearch {
 public:
  // `near`: all pairs of shells that are near, chunk by chunk.
  EdgeSearch(const Surface<3>& surface, const ContactOptions& options, const ShellTable<3>& table,
             std::vector<std::vector<NearEdges>> near);

  // In the order of the semi-edges. See target_search.h.
  [[nodiscard]] std::vector<TakenEdge> taken(const std::vector<FaceId>& spring_targets);

 private:
  // A semi-edge (face * 3 + side) and a target edge.
  struct Touching : Candidate<EdgeId> {
    std::uint32_t semi_edge;
    EdgeTouch touch;
  };
  class Asking;

  const Surface<3>& surface_;  // of the caller, who keeps them
  const ContactOptions& options_;
  const ShellTable<3>& table_;
  std::vector<std::vector<NearEdges>> near_;
};

}  // namespace scree::contact
