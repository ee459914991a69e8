// Which target edge each semi-edge takes, where semi-springs have missed the contact. 3-D only.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/edge_pairs.h"
#include "contact/find_contacts.h"
#include "contact/near_shells.h"
#include "contact/touch.h"
#include "engine/base/parts.h"

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

// In the order of the semi-edges. `near`: all pairs of shells of the table that are near, emptied as soon as they are read;
// `spring_blocks`: the blocks of the targets of semi-springs. See target_search.h.
std::vector<TakenEdge> find_edge_targets(const Surface<3>& surface, const ContactOptions& options, const ShellTable<3>& table,
                                         Parts<NearEdges>& near, const LargeVector<BlockId>& spring_blocks);

}  // namespace scree::contact
