// Which target face each semi-spring takes.
#pragma once

#include <array>
#include <cstdint>

#include "contact/find_contacts.h"
#include "contact/near_springs.h"
#include "engine/base/parts.h"

namespace scree::contact {

// How a semi-spring touches the target it takes.
template <int dim>
struct SpringTouch {
  double gap;                         // [m]
  std::array<double, dim> on_target;  // weights
};

// Of corner c of face f at f * dim + c.
template <int dim>
struct SpringTargets {
  // None yet.
  explicit SpringTargets(const Surface<dim>& surface)
      : faces(surface.faces.size() * dim), blocks(faces.size()), touches(faces.size()) {}

  void take(std::size_t spring, FaceId face, BlockId block, const SpringTouch<dim>& touch) {
    faces[spring] = face;
    blocks[spring] = block;
    touches[spring] = touch;
  }

  LargeVector<FaceId> faces;                     // invalid if it touches nothing
  LargeVector<BlockId> blocks;                   // those of these faces
  VectorWrittenLater<SpringTouch<dim>> touches;  // of those that have a target
};

// Finds those that are not known yet. `near`: all pairs of shells of the table that are near, emptied as soon as they are read.
// See target_search.h.
template <int dim>
void find_spring_targets(const Surface<dim>& surface, const ContactOptions& options, const ShellTable<dim>& table,
                         Parts<NearSprings>& near, SpringTargets<dim>& targets);

}  // namespace scree::contact
