// Which target face each semi-spring takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/near_shells.h"

namespace scree::contact {

// A semi-spring that touches, the target it takes, and how.
template <int dim>
struct SpringTouch {
  std::uint32_t spring;  // of corner c of face f: f * dim + c
  FaceId target;
  double gap;                         // [m]
  std::array<double, dim> on_target;  // weights
};

// Is shown all pairs of shells that are near, then asked.
template <int dim>
class SpringSearch {
 public:
  SpringSearch(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table);

  // From any thread, one at a time for each chunk.
  void look_at(std::size_t chunk, const ShellPair<dim>& pair);

  // See target_search.h. Chunk by chunk of the shells.
  [[nodiscard]] std::vector<std::vector<SpringTouch<dim>>> touches();

 private:
  void link();

  const Surface<dim>& surface_;  // of the caller, who keeps them
  const ContactOptions& options_;
  const ShellTable<dim>& table_;
  // A shell that semi-springs may touch.
  struct Other {
    std::uint32_t place : 31;
    std::uint32_t
        close : 1;  // a whole face may: such shells are looked at first, and often leave the others out of the running
    float bound;    // no semi-spring is nearer [m]
  };
  struct Near {
    std::uint32_t own;
    Other other;
  };
  void add(std::size_t chunk, std::uint32_t own, std::uint32_t other, const Heights<dim>& above_other, float rounding);

  std::vector<std::vector<Near>> near_;  // of each chunk
  std::vector<std::uint32_t> starts_;    // of each shell in others_, and the end
  std::vector<Other> others_;            // in no order of note
};

}  // namespace scree::contact
