// Which target face each semi-spring takes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/near_shells.h"

namespace scree::contact {

// Is shown all pairs of shells that are near, then asked.
template <int dim>
class SpringSearch {
 public:
  SpringSearch(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table);

  // From any thread, one at a time for each chunk.
  void look_at(std::size_t chunk, const ShellPair<dim>& pair);

  // Of corner c of face f at f * dim + c; invalid if it touches nothing. See target_search.h.
  [[nodiscard]] std::vector<FaceId> targets();

 private:
  using Places = std::pair<std::uint32_t, std::uint32_t>;  // of a shell whose semi-springs may touch, and of the other

  void link();

  const Surface<dim>& surface_;  // of the caller, who keeps them
  const ContactOptions& options_;
  const ShellTable<dim>& table_;
  std::vector<std::vector<Places>> near_;  // of each chunk
  std::vector<std::size_t> starts_;        // of each shell in `others_`
  std::vector<std::uint32_t> others_;
};

}  // namespace scree::contact
