// Which target face each semi-spring takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/near_springs.h"

namespace scree::contact {

// A semi-spring that touches, the target it takes, and how.
template <int dim>
struct SpringTouch {
  std::uint32_t spring;  // of corner c of face f: f * dim + c
  FaceId target;
  double gap;                         // [m]
  std::array<double, dim> on_target;  // weights
};

template <int dim>
class SpringSearch {
 public:
  // `near`: all pairs of shells that are near, chunk by chunk.
  SpringSearch(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table,
               std::vector<std::vector<NearSprings>> near);

  // See target_search.h. Chunk by chunk of the shells.
  [[nodiscard]] std::vector<std::vector<SpringTouch<dim>>> touches();

 private:
  void link(std::vector<std::vector<NearSprings>>&& near);

  const Surface<dim>& surface_;  // of the caller, who keeps them
  const ContactOptions& options_;
  const ShellTable<dim>& table_;
  std::vector<std::uint32_t> starts_;  // of each shell in others_, and the end
  std::vector<NearShell> others_;      // in no order of note
};

}  // namespace scree::contact
