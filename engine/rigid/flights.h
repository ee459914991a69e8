// Bodies that fell apart into blocks and still fly as they were meshed.
//
// Blocks of one body start with one velocity and fall under one gravity and drag, so as long as nothing else is near any of
// them they do not move to each other, and no force acts between them, however closely they touch: they are one body. A fresh
// mesh has some twenty touching neighbours to a block, and one step of those would cost more than ten of a settled pile.
#pragma once

#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::rigid {

class Flights {
 public:
  // Every free body of several blocks flies, unless its blocks are let go one by one.
  Flights(const mesh::BlockMesh<3>& mesh, bool one_by_one);

  // Two blocks have come near each other: the flights of their bodies end, if they are of different bodies.
  void meet(int first_block, int second_block);

  // Whether two blocks are of one body that still flies.
  [[nodiscard]] bool together(int first_block, int second_block) const;

  [[nodiscard]] int count() const;  // of the bodies that still fly

 private:
  std::vector<int> body_;     // of each block
  std::vector<char> flying_;  // each body
};

}  // namespace scree::rigid
