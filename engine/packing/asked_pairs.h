// Which pairs of blocks somebody asks about.
#pragma once

#include "engine/mesh/block_mesh.h"

namespace scree::packing {

enum class Pairs { with_a_free_block, all, of_different_bodies };

// Whose a piece is.
struct Owner {
  BlockId block;
  BodyId body;
  bool fixed = false;
};

template <int dim>
Owner owner_of(const mesh::BlockMesh<dim>& mesh, BlockId block) {
  const BodyId body = mesh.blocks[block].body;
  return {block, body, mesh.bodies[body].fixed};
}

// No block makes a pair with itself.
inline bool is_asked(Pairs asked, const Owner& a, const Owner& b) {
  switch (asked) {
    case Pairs::with_a_free_block:
      return a.block != b.block && !(a.fixed && b.fixed);
    case Pairs::of_different_bodies:
      return a.body != b.body;
    case Pairs::all:
      break;
  }
  return a.block != b.block;
}

}  // namespace scree::packing
