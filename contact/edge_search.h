// Which target edge each semi-edge takes, where semi-springs have missed the contact. 3-D only.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/choice.h"
#include "contact/edge_pairs.h"
#include "contact/find_contacts.h"
#include "contact/near_shells.h"

namespace scree::contact {

// Is shown all pairs of shells that are near, then asked.
class EdgeSearch {
 public:
  EdgeSearch(const Surface<3>& surface, const ContactOptions& options, const ShellTable<3>& table);

  // From any thread, one at a time for each chunk.
  void look_at(std::size_t chunk, const ShellPair<3>& pair);

  // Of side s of face f at f * 3 + s; invalid if it touches nothing. See target_search.h.
  [[nodiscard]] std::vector<EdgeId> targets(const std::vector<FaceId>& spring_targets);

 private:
  // Two shells and those of their edges that may touch.
  struct Near {
    std::uint32_t first;
    std::uint32_t second;
    EdgePairs edges;
  };
  // A semi-edge (face * 3 + side) and a target edge.
  struct Touching {
    std::uint32_t semi_edge;
    Candidate<EdgeId> candidate;
  };
  class Asking;

  const Surface<3>& surface_;  // of the caller, who keeps them
  const ContactOptions& options_;
  const ShellTable<3>& table_;
  std::vector<std::vector<Near>> near_;  // of each chunk
};

}  // namespace scree::contact
